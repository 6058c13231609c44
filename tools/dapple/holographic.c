/* Settings of the holographic solver on the command line. */
#include "holographic.h"

#include <string.h>

static const dpl_choice storages[] = {
    {"float", DPL_STORAGE_FLOAT},
    {"half", DPL_STORAGE_HALF},
    {NULL, 0},
};

static const dpl_choice resolutions[] = {
    {"full", DPL_RESOLUTION_FULL},
    {"half", DPL_RESOLUTION_HALF},
    {"quarter", DPL_RESOLUTION_QUARTER},
    {"double", DPL_RESOLUTION_DOUBLE},
    {NULL, 0},
};

void dpl_holographic_fill_options(dpl_holographic_settings *settings,
                                  dpl_option options[DPL_HOLOGRAPHIC_OPTION_COUNT]) {
    const dpl_option rows[DPL_HOLOGRAPHIC_OPTION_COUNT] = {
        {.name = "storage",
         .kind = DPL_OPTION_CHOICE,
         .target = &settings->storage,
         .choices = storages,
         .given = &settings->given},
        {.name = "resolution",
         .kind = DPL_OPTION_CHOICE,
         .target = &settings->resolution,
         .choices = resolutions,
         .given = &settings->given},
    };
    memcpy(options, rows, sizeof rows);
}

static const char *name_of(const dpl_choice *choices, int value) {
    while (choices->name && choices->value != value)
        choices++;
    return choices->name ? choices->name : "?";
}

const char *dpl_holographic_storage_name(dpl_storage storage) {
    return name_of(storages, (int)storage);
}

const char *dpl_holographic_resolution_name(dpl_resolution resolution) {
    return name_of(resolutions, (int)resolution);
}
