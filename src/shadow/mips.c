/* Makes the coarser levels of the signed distance, see mips.h. */
#include "shadow/mips.h"

static int32_t half_up(int32_t size) {
    return (size + 1) / 2;
}

dpl_distances dpl_mips_level(const dpl_mips *mips, const dpl_solid *solid, int32_t level) {
    dpl_distances d = {solid->distance.data, solid->width, solid->height, 1.0f, DPL_CORNER_LOSS};
    for (int32_t k = 0; k < level; k++) {
        d.data = mips->levels[k].data;
        d.width = half_up(d.width);
        d.height = half_up(d.height);
        d.scale *= 0.5f;
        d.loss *= 2.0f;
    }
    return d;
}

/* At an odd size's end the last row and column count twice. */
static void halve(const dpl_distances *from, float *to) {
    int32_t width = half_up(from->width), height = half_up(from->height);
    for (int32_t y = 0; y < height; y++) {
        const float *top = from->data + (size_t)y * 2 * (size_t)from->width;
        const float *bottom = 2 * y + 1 < from->height ? top + from->width : top;
        for (int32_t x = 0; x < width; x++) {
            int32_t a = 2 * x, b = a + 1 < from->width ? a + 1 : a;
            to[(size_t)y * (size_t)width + (size_t)x] = 0.25f * ((top[a] + top[b]) + (bottom[a] + bottom[b]));
        }
    }
}

dpl_status dpl_mips_update(dpl_mips *mips, dpl_context *context, const dpl_solid *solid, int32_t level) {
    if (mips->revision != solid->revision)
        mips->level = 0;
    mips->revision = solid->revision;
    for (int32_t k = mips->level; k < level; k++) {
        dpl_distances from = dpl_mips_level(mips, solid, k);
        size_t count = (size_t)half_up(from.width) * (size_t)half_up(from.height);
        DPL_TRY(dpl_buffer_reserve(context, &mips->levels[k], count, sizeof(float)));
        halve(&from, mips->levels[k].data);
        mips->level = k + 1;
    }
    return DPL_OK;
}

void dpl_mips_free(dpl_context *context, dpl_mips *mips) {
    for (int k = 0; k < DPL_MIPS_MOST; k++)
        dpl_buffer_free(context, &mips->levels[k]);
}
