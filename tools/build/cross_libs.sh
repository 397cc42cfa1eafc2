#!/bin/sh
# cross_libs.sh: compiles cmocka, zlib, cJSON and METIS for a platform (make test-s390x)
#
#     CC=COMPILER AR=ARCHIVER tools/build/cross_libs.sh FOLDER [metis]
#
# Compiles Debian's source packages, unmodified, with CC into FOLDER/libcmocka.a, libz.a,
# libcjson.a and, if asked, libmetis.a. Copies their headers to FOLDER/include. The sources are
# fetched once, by apt-get into build/sources; that needs no rights and changes nothing in the
# system, because apt-get gets its own list of repositories.

folder=$1 with_metis=$2
sources=build/sources
root=$PWD
log=$folder/libs.log
[ -e "$folder/all-libs.ok" ] && exit 0
mkdir -p "$folder/include" $sources || exit 1

fetch() {
    mkdir -p $sources/lists/partial || return 1
    . /etc/os-release
    echo "deb-src http://deb.debian.org/debian $VERSION_CODENAME main" >$sources/apt.list
    set -- -o "Dir::Etc::SourceList=$root/$sources/apt.list" -o Dir::Etc::SourceParts=/dev/null \
        -o "Dir::State::Lists=$root/$sources/lists"
    apt-get "$@" update &&
        (cd $sources && apt-get "$@" source --download-only cmocka zlib cjson metis) || return 1
    for archive in $sources/*.orig.tar.*; do
        case $archive in *.asc) continue ;; esac
        tar -xf "$archive" -C $sources || return 1
    done
}

# archive NAME FLAGS FILE...: compiles the files into libNAME.a. FLAGS is one string.
archive() {
    name=$1 flags=$2
    shift 2
    mkdir -p "$folder/obj" && rm -f "$folder/obj"/*.o "$folder/lib$name.a"
    number=0 # METIS and GKlib have files of the same name
    for file in "$@"; do
        number=$((number + 1))
        $CC -O1 -w $flags -c "$file" -o "$folder/obj/$number.o" || return 1
    done
    $AR rcs "$folder/lib$name.a" "$folder/obj"/*.o
}

# GKlib is part of METIS.
build() {
    cmocka=$(echo $sources/cmocka-*/) zlib=$(echo $sources/zlib-*/) metis=$(echo $sources/metis-*/)
    cjson=$(echo $sources/c*JSON-*/)
    gklib=
    for part in b64 blas csr error evaluate fkvkselect fs getopt graph htable io itemsets mcore \
        memory omp pdb pqueue random rw seq sort string timers tokenizer util; do
        gklib="$gklib $metis/GKlib/$part.c"
    done
    mkdir -p "$folder/include/cjson" && cp "$cjson"/cJSON.h "$folder/include/cjson" &&
        cp "$cmocka"/include/*.h "$zlib"/zlib.h "$zlib"/zconf.h "$metis"/include/metis.h \
        "$folder/include" &&
        archive cmocka "-DHAVE_SIGLONGJMP -DHAVE_STRSIGNAL -DHAVE_SIGNAL_H -DHAVE_MALLOC_H
            -DHAVE_INTTYPES_H -DHAVE_STRINGS_H -DHAVE_STRUCT_TIMESPEC -DHAVE_CLOCK_REALTIME
            -D_GNU_SOURCE -I$cmocka/include" "$cmocka"/src/cmocka.c &&
        archive z "-DHAVE_UNISTD_H -D_LARGEFILE64_SOURCE=1" "$zlib"/*.c &&
        archive cjson "" "$cjson"/cJSON.c || return 1
    [ -z "$with_metis" ] ||
        archive metis "-std=gnu99 -DLINUX -DNDEBUG -DNDEBUG2 -D_FILE_OFFSET_BITS=64
            -I$metis/GKlib -I$metis/include -I$metis/libmetis" "$metis"/libmetis/*.c $gklib
}

{
    { # one at a time, so that two targets do not fetch into the same folder
        if command -v flock >/dev/null 2>&1; then flock 9; fi
        [ -e $sources/all.ok ] || { fetch && touch $sources/all.ok; }
    } 9>$sources/lock && build && touch "$folder/all-libs.ok"
} >"$log" 2>&1 && exit 0
tail -n 20 "$log" >&2
echo "fix: the messages above are those of $log" >&2
exit 1
