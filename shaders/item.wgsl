// One invocation per item, however many there are: groups of GROUP invocations in x, and rows of groups in y where x
// is full. Part of every kernel that works on a flat list; web/webgpu/plan.js dispatches it.

const GROUP: u32 = 128u;

fn item_of(group: vec3u, groups: vec3u, local: u32) -> u32 {
    return (group.y * groups.x + group.x) * GROUP + local;
}
