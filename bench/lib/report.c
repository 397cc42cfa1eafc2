/* report.c: prints a measurement as a line of a table and writes it to a CSV file */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

struct bench_report {
    char name[32];
    FILE *csv;
    const bench_system *system; /* of the last row printed */
};

bench_report *bench_report_open(const bench_run *run, const char *name, const char *question,
                                const char *baseline) {
    bench_report *report = bench_alloc(1, sizeof *report);
    char path[512];
    memset(report, 0, sizeof *report);
    snprintf(report->name, sizeof report->name, "%s", name);
    snprintf(path, sizeof path, "%s/%s.csv", run->out_dir, name);
    report->csv = bench_create(path);
    bench_machine_write(run, name);
    fprintf(report->csv,
            "question,system,n,nnz_l,nnz_panels,isa,threads,case,method,nrhs,b_columns,x_columns,b_"
            "entries,"
            "x_entries,entries,flops,count,min_s,median_s,max_s,gb_per_s,gflop_per_s,limit_s,"
            "limit_share,ratio\n");
    printf("\n== %s: %s\n   ratio: time / time of %s\n"
           "   L read: doubles of L read in both sweeps\n"
           "   limit: the time that the cores in use need to read them or to do the operations, "
           "whichever is\n"
           "   longer, as a share of the median\n",
           name, question, baseline);
    return report;
}

const char *bench_time_text(char *text, size_t size, double seconds) {
    static const char *const units[] = {"ns", "us", "ms", "s "};
    double value = seconds * 1e9;
    int unit = 0;
    while (unit < 3 && value >= 999.5) {
        value /= 1000;
        unit++;
    }
    snprintf(text, size, "%.*f %s",
             value >= 99.95   ? 1
             : value >= 9.995 ? 2
                              : 3,
             value, units[unit]);
    return text;
}

static void print_heading(const bench_system *system) {
    printf("\n%s: n %d, nnz(A) %.4g, nnz(L) %.4g, panels %.4g (%.2f), %.4g flops\n", system->name,
           (int)system->n, (double)system->stats.symbolic.nnz_a,
           (double)system->stats.symbolic.nnz_l, (double)system->stats.symbolic.nnz_panels,
           (double)system->stats.symbolic.nnz_panels /
               (double)(system->stats.symbolic.nnz_l > 0 ? system->stats.symbolic.nnz_l : 1),
           system->stats.symbolic.flops);
    printf("  %-14s %-26s %-6s %3s %3s %10s %9s %9s %9s %10s %5s %8s\n", "case", "method", "isa",
           "thr", "rhs", "L read", "min", "median", "max", "rate", "limit", "ratio");
}

/* Lower bound of the time in seconds: the time to read L or to do the operations. */
static double limit_of(const bench_row *row, sl_isa isa) {
    const double threads = row->threads > 1 ? row->threads : 1, peak = threads * bench_peak(isa);
    const double bytes = 8 * row->entries;
    double seconds = 0, flops = row->flops;
    if (bytes > 0) {
        /* both sweeps read about the same block of memory */
        seconds = bytes / bench_bandwidth(bytes / (row->passes > 1 ? 2 * row->passes : 2));
        flops += 2 * row->entries * (row->passes > 1 || row->nrhs < 1 ? 1 : row->nrhs);
    }
    return peak > 0 && flops / peak > seconds ? flops / peak : seconds;
}

static void print_row(const bench_row *row, sl_isa isa, double seconds, double limit) {
    char min[32], median[32], max[32], rate[32] = "-", share[32] = "-", ratio[32] = "-",
                                       read[32] = "-";
    if (row->flops > 0) {
        snprintf(rate, sizeof rate, "%.1f GF/s", row->flops / seconds * 1e-9);
    } else if (row->entries > 0) {
        snprintf(rate, sizeof rate, "%.1f GB/s", 8 * row->entries / seconds * 1e-9);
    }
    if (limit > 0) {
        snprintf(share, sizeof share, "%.0f%%", 100 * limit / seconds);
    }
    if (row->entries > 0) {
        snprintf(read, sizeof read, "%.0f", row->entries);
    }
    if (row->baseline > 0) {
        snprintf(ratio, sizeof ratio, "%.2f", seconds / row->baseline);
    }
    printf("  %-14s %-26s %-6s %3d %3d %10s %9s %9s %9s %10s %5s %8s\n", row->what, row->method,
           row->is_peer ? "own" : bench_isa_name(isa), row->threads > 1 ? (int)row->threads : 1,
           (int)row->nrhs, read, bench_time_text(min, sizeof min, row->time.min),
           bench_time_text(median, sizeof median, row->time.median),
           bench_time_text(max, sizeof max, row->time.max), rate, share, ratio);
    fflush(stdout);
}

void bench_report_row(bench_report *report, const bench_system *system, const bench_row *row) {
    const double seconds = row->time.median > 0 ? row->time.median : 1e-9;
    const sl_isa isa = row->isa == SL_ISA_AUTO ? system->stats.factor.isa : row->isa;
    const double limit = limit_of(row, isa);
    if (report->system != system) {
        print_heading(system);
        report->system = system;
    }
    print_row(row, isa, seconds, limit);
    bench_summary_keep(report->name, system, row);
    fprintf(report->csv,
            "%s,\"%s\",%d,%lld,%lld,%s,%d,\"%s\",\"%s\",%d,%d,%d,%lld,%lld,%.0f,%.0f,%d,%.9g,%.9g,%"
            ".9g,%.4g,%."
            "4g,%.4g,%.4g,%.4g\n",
            report->name, system->name, (int)system->n, (long long)system->stats.symbolic.nnz_l,
            (long long)system->stats.symbolic.nnz_panels,
            row->is_peer ? "own" : bench_isa_name(isa), row->threads > 1 ? (int)row->threads : 1,
            row->what, row->method, (int)row->nrhs, (int)row->reach.plan.b_columns,
            (int)row->reach.plan.x_columns, (long long)row->reach.plan.b_entries,
            (long long)row->reach.plan.x_entries, row->entries, row->flops, row->time.count,
            row->time.min, row->time.median, row->time.max, 8 * row->entries / seconds * 1e-9,
            row->flops / seconds * 1e-9, limit, limit / seconds,
            row->baseline > 0 ? seconds / row->baseline : 0);
}

void bench_report_note(bench_report *report, const char *format, ...) {
    (void)report;
    va_list arguments;
    va_start(arguments, format);
    printf("  ");
    vprintf(format, arguments);
    printf("\n");
    va_end(arguments);
}

void bench_report_close(bench_report *report) {
    bench_close(report->csv);
    free(report);
}

void bench_row_reach(bench_row *row, const sl_stats *stats) {
    row->reach = *stats;
    row->entries = (double)stats->plan.b_entries + (double)stats->plan.x_entries;
}

void bench_row_full(bench_row *row, const bench_system *system) {
    row->reach.plan.b_columns = row->reach.plan.x_columns = system->n;
    row->reach.plan.b_entries = row->reach.plan.x_entries = system->stats.symbolic.nnz_panels;
    row->entries = 2 * (double)system->stats.symbolic.nnz_panels;
}
