/* Tries more and more digits until the text reads back. */
#include "number_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Same value and same sign of zero, without comparing floats with ==. */
static int same(double a, double b) {
    return memcmp(&a, &b, sizeof a) == 0;
}

dpl_number_text dpl_number_text_double(double value) {
    dpl_number_text number;
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(number.text, sizeof number.text, "%.*g", digits, value);
        if (same(strtod(number.text, NULL), value))
            break;
    }
    return number;
}

dpl_number_text dpl_number_text_float(float value) {
    dpl_number_text number;
    for (int digits = 4; digits <= 9; digits++) {
        snprintf(number.text, sizeof number.text, "%.*g", digits, (double)value);
        if (same((double)(float)strtod(number.text, NULL), (double)value))
            break;
    }
    return number;
}
