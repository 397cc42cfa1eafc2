/* colors.h: colors of pictures: a perceptually uniform map for numbers, a palette for categories */
#ifndef TOOLS_COLORS_H
#define TOOLS_COLORS_H

#include "tools/mesh/rgb.h"

/** The color of t in 0..1, from dark blue to yellow with uniform steps of lightness. Values outside
 *  0..1 get the color of the nearer end, NaN is gray.
 *
 *  Source  viridis of matplotlib, by Nathaniel Smith and Stefan van der Walt, public domain (CC0):
 *          16 of its colors, linear interpolation between them.
 */
rgb color_map(double t);

/** The color of category k = 0, 1, ...: eight colors that color-blind readers can distinguish, then
 *  cyclically.
 *
 *  Source  Okabe and Ito, Color universal design, 2008 (without their black).
 */
rgb color_of_kind(int k);

/** (1 - t) a + t b, for t in 0..1. */
rgb color_mix(rgb a, rgb b, double t);

#endif
