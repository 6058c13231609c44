/* Numbers as the shortest text that reads back to the same number. Used by the writer and in errors. */
#ifndef DPL_SCENES_NUMBER_TEXT_H
#define DPL_SCENES_NUMBER_TEXT_H

/* Room for any number. */
typedef struct dpl_number_text {
    char text[32];
} dpl_number_text;

/* Of a finite double. */
dpl_number_text dpl_number_text_double(double value);

/* Of a finite float: reads back to the same float. */
dpl_number_text dpl_number_text_float(float value);

#endif
