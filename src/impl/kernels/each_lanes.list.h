/* each_lanes.list.h: one instruction set: includes SLI_FOR_LANES once for each of its numbers of
 * right-hand sides
 *
 * These are the passes in SLI_LANES. Templates that are compiled in one of them ask for it. */

#define SLW_PASS 1
#include SLI_WORDS
#include SLI_LANES
#include SLI_FOR_LANES

#if defined(SLV_NAME) /* that was not the last pass */
#define SLW_PASS 2
#include SLI_LANES
#include SLI_FOR_LANES
#endif

#if defined(SLV_NAME)
#define SLW_PASS 3
#include SLI_LANES
#include SLI_FOR_LANES
#endif
