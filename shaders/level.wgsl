// One level of radiance cascades: for a slot of a probe, march the slot's rays over their interval, put the level above
// behind what they let through, and store the mean (src/cascade/level.c). Dispatched once per level, the top one first.

struct Level {
    picture: vec2u, // [px]
    probes: vec2u,
    above: vec2u, // probes of the level above
    slots: u32,
    number: u32,
    first_direction: u32, // of this level in `directions`
    spacing: f32, // [px]
    t0: f32, // rays begin here [px]
    t1: f32, // and end here
    furthest: f32, // from its probe a ray may get so far [px]
}

override MERGE: u32 = 0u; // one of the following
const TOP: u32 = 0u; // there is no level above, only the sky
const BILINEAR: u32 = 1u;
const BILINEAR_FIX: u32 = 2u;
const NEAREST_FIX: u32 = 3u;

const BRANCHING: u32 = 4u; // rays of a slot

@group(0) @binding(0) var<uniform> level: Level;
@group(0) @binding(4) var<storage, read> directions: array<vec2f>; // in steps of half a ray: ray k points along 2k+1
@group(0) @binding(5) var<storage, read> above: array<vec4f>; // [slot][row][probe]
@group(0) @binding(6) var<storage, read_write> radiance: array<vec4f>; // [slot][row][probe]
@group(0) @binding(7) var<storage, read_write> counters: array<atomic<u32>>; // rays, by level
@group(0) @binding(8) var<uniform> rule: SkipRule; // the same for all levels of a frame
@group(0) @binding(9) var<uniform> sky: vec3f;

struct Probe {
    at: vec2i,
    is_clear: bool, // its rays meet nothing
}

// Neighbouring rays of a slot that one traced ray stands for: it points to their middle and sees the mean of the slots
// above that they would have seen.
struct Group {
    direction: vec2f,
    first_slot: u32, // above
    slot_count: u32,
    share: f32, // of the slot
}

fn group_from(ray: u32, step: u32) -> Group {
    return Group(directions[level.first_direction + 2u * ray + step], ray, step, f32(step) / f32(BRANCHING));
}

// Beyond the border the last parent stands in for those that are missing.
fn nearest_above(probe: vec2i) -> vec2i {
    return clamp(probe, vec2i(0), vec2i(level.above) - 1);
}

// Where a probe above is in its slot.
fn place_above(probe: vec2i) -> u32 {
    return u32(probe.y) * level.above.x + u32(probe.x);
}

fn read_above(slot: u32, place: u32) -> vec3f {
    return above[slot * (level.above.x * level.above.y) + place].rgb;
}

// What a group sees of one probe above.
fn mean_above(group: Group, probe: vec2i) -> vec3f {
    let place = place_above(probe);
    var sum = read_above(group.first_slot, place);
    for (var s = 1u; s < group.slot_count; s++) {
        sum += read_above(group.first_slot + s, place);
    }
    return sum * (1.0 / f32(group.slot_count));
}

fn read_between(slot: u32, upper: u32, lower: u32, share: f32) -> vec3f {
    let a = read_above(slot, upper);
    return a + (read_above(slot, lower) - a) * share;
}

// What it sees between two probes above, one below the other.
fn mean_between(group: Group, upper: u32, lower: u32, share: f32) -> vec3f {
    var sum = read_between(group.first_slot, upper, lower, share);
    for (var s = 1u; s < group.slot_count; s++) {
        sum += read_between(group.first_slot + s, upper, lower, share);
    }
    return sum * (1.0 / f32(group.slot_count));
}

// What it sees between the four probes above that are nearest.
fn mean_around(group: Group, probe: vec2i) -> vec3f {
    let lower = vec2i(lower_parent(probe.x), lower_parent(probe.y));
    let a = nearest_above(lower);
    let b = nearest_above(lower + 1);
    let share = upper_share(probe.y);
    let left = mean_between(group, place_above(a), place_above(vec2i(a.x, b.y)), share);
    let right = mean_between(group, place_above(vec2i(b.x, a.y)), place_above(b), share);
    return left + (right - left) * upper_share(probe.x);
}

// Is there nothing that a ray of this probe could meet?
fn is_clear(probe: vec2i) -> bool {
    let cell = cell_of(vec2i(floor(probe_position(probe, level.spacing))), level.picture);
    return cell != NOWHERE && clearance[cell] - TWO_HALF_DIAGONALS >= level.furthest;
}

// From the probe's t0 to t1 along the way from `aim`, which is the probe itself or a parent.
fn gather_light(probe: Probe, group: Group, aim: vec2f) -> Interval {
    let start = probe_position(probe.at, level.spacing) + group.direction * level.t0;
    var seen = Interval(vec3f(0.0), vec3f(1.0));
    // A branch. Written as a loop it is skipped by what runs probes in lockstep, where no probe needs it.
    for (var is_near = !probe.is_clear; is_near; is_near = false) {
        seen = march(start, aim + group.direction * level.t1, level.picture);
    }
    return seen;
}

fn trace_straight(probe: Probe, group: Group) -> vec3f {
    let seen = gather_light(probe, group, probe_position(probe.at, level.spacing));
    var beyond = sky;
    if (MERGE == BILINEAR) {
        beyond = mean_around(group, probe.at);
    }
    return group.share * (seen.radiance + seen.passed * beyond);
}

// A ray of its own for a parent, which ends where that parent's begins, so that the two join without a seam.
fn trace_to_parent(probe: Probe, group: Group, parent: vec2i, weight: f32) -> vec3f {
    let place = nearest_above(parent);
    let seen = gather_light(probe, group, probe_position(place, 2.0 * level.spacing));
    return weight * (seen.radiance + seen.passed * mean_above(group, place));
}

fn trace_to_all_parents(probe: Probe, group: Group, sum: vec3f) -> vec3f {
    let lower = vec2i(lower_parent(probe.at.x), lower_parent(probe.at.y));
    let upper = vec2f(upper_share(probe.at.x), upper_share(probe.at.y));
    var light = sum;
    for (var b = 0; b < 4; b++) {
        let side = vec2i(b & 1, b >> 1u);
        let shares = select(1.0 - upper, upper, side == vec2i(1));
        light += trace_to_parent(probe, group, lower + side, shares.x * shares.y * group.share);
    }
    return light;
}

@compute @workgroup_size(GROUP)
fn solve(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) groups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    let item = item_of(workgroup, groups, local);
    let probes = level.probes.x * level.probes.y;
    if (item >= probes * level.slots) {
        return;
    }
    let slot = item / probes;
    let place = item - slot * probes;
    let row = place / level.probes.x;
    let at = vec2i(i32(place - row * level.probes.x), i32(row));
    let probe = Probe(at, is_clear(at));
    let step = arcStep(level.number, rule);
    var sum = vec3f(0.0);
    var rays = 0u;
    for (var j = 0u; j < BRANCHING; j += step) {
        let group = group_from(slot * BRANCHING + j, step);
        if (MERGE == BILINEAR_FIX) {
            sum = trace_to_all_parents(probe, group, sum);
            rays += 4u;
        } else if (MERGE == NEAREST_FIX) {
            sum += trace_to_parent(probe, group, at / 2, group.share);
            rays += 1u;
        } else {
            sum += trace_straight(probe, group);
            rays += 1u;
        }
    }
    radiance[item] = vec4f(sum, 0.0);
    atomicAdd(&counters[level.number], rays);
}
