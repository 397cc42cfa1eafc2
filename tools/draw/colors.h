/* colors.h: colours: a perceptual map for numbers, a palette for kinds */
#ifndef TOOLS_COLORS_H
#define TOOLS_COLORS_H

typedef struct rgb {
    unsigned char r, g, b;
} rgb;

/** The colour of t in 0..1, dark blue to yellow with even steps of lightness; outside it is the nearer end, NaN is grey.
 *
 *  Source  viridis of matplotlib, by Nathaniel Smith and Stefan van der Walt, given to the public domain (CC0):
 *          16 of its colours, straight lines between them.
 */
rgb color_map(double t);

/** A colour for kind k = 0, 1, ...: eight that remain apart for colour-blind eyes, then again.
 *
 *  Source  Okabe and Ito, Color universal design, 2008 (without their black).
 */
rgb color_of_kind(int k);

/** a (t = 0) to b (t = 1), straight. */
rgb color_mix(rgb a, rgb b, double t);

#endif
