// The same headers from C++: owners made of the destroy functions, and the schedule as plain data. Built by
// with_cmake.sh and with_pkg_config.sh against an installed Dapple.
#include <dapple/dapple.h>

#include <cstdio>
#include <memory>
#include <vector>

namespace {

struct destroyer {
    void operator()(dpl_context *context) const {
        dpl_context_destroy(context);
    }
    void operator()(dpl_field *field) const {
        dpl_field_destroy(field);
    }
};

template <typename T> using owner = std::unique_ptr<T, destroyer>;

// Distance from the top left pixel to the one wall, or -1.
float distance_to_wall(dpl_context *context) {
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = desc.height = 32;
    dpl_field *made = nullptr;
    if (dpl_field_create(context, &desc, &made) != DPL_OK)
        return -1.0f;
    owner<dpl_field> field(made);
    dpl_shape wall = dpl_shape_default(DPL_SHAPE_DISC);
    wall.disc.center[0] = 30.5;
    wall.disc.center[1] = 0.5;
    wall.disc.radius = 0.25;
    std::vector<float> distance(32 * 32);
    if (dpl_field_draw_shapes(field.get(), &wall, 1) != DPL_OK ||
        dpl_field_read_distance(field.get(), distance.data(), 0) != DPL_OK)
        return -1.0f;
    return distance[0];
}

} // namespace

int main() {
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = 2;
    dpl_context *made = nullptr;
    dpl_status status = dpl_context_create(&desc, &made);
    if (status != DPL_OK) {
        std::fprintf(stderr, "%s\n", dpl_status_text(status));
        return 1;
    }
    owner<dpl_context> context(made);
    float distance = distance_to_wall(context.get());
    dpl_schedule schedule;
    status = dpl_schedule_compute(nullptr, 512, 512, &schedule);
    std::printf("dapple %s: wall at %.1f px, %d levels\n", dpl_version(), static_cast<double>(distance),
                static_cast<int>(schedule.level_count));
    return distance == 30.0f && status == DPL_OK && schedule.level_count > 1 ? 0 : 1;
}
