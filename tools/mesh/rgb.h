/* rgb.h: a color of 8 bits per channel */
#ifndef TOOLS_RGB_H
#define TOOLS_RGB_H

typedef struct rgb {
    unsigned char r, g, b;
} rgb;

#endif
