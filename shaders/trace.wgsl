// A level of cascades, second half: marches the rays that may meet something, of the items that clear.wgsl has listed.
// Invocations take items in turn until the list is at its end.

@group(0) @binding(7) var<storage, read> counters: array<u32>; // as clear.wgsl leaves it
@group(0) @binding(11) var<storage, read> near: array<Near>;

// Neighbouring rays of a slot that one traced ray stands for: it points to their middle and sees the mean of the slots
// above that they would have seen.
struct Group {
    direction: vec2f,
    first_slot: u32, // above
    slot_count: u32,
    share: f32, // of the slot
    free: f32, // share of their way on which they meet nothing
}

fn group_from(ray: u32, step: u32, free: f32) -> Group {
    return Group(directions[level.first_direction + 2u * ray + step], ray, step, f32(step) / f32(BRANCHING), free);
}

// What a group sees of one parent.
fn mean_above(block: Block, group: Group, parent: vec2i) -> vec3f {
    var sum = vec3f(0.0);
    var s = 0u;
    loop {
        sum += read_above(block, group.first_slot + s, parent);
        continuing {
            s++;
            break if s >= group.slot_count;
        }
    }
    return sum * (1.0 / f32(group.slot_count));
}

// What a group sees of all four of them.
fn mean_between(block: Block, group: Group) -> Four {
    var sum = Four(vec3f(0.0), vec3f(0.0), vec3f(0.0), vec3f(0.0));
    var s = 0u;
    loop {
        let slot = group.first_slot + s;
        let parents = Four(read_above(block, slot, parent_at(block, 0u)), read_above(block, slot, parent_at(block, 1u)),
                           read_above(block, slot, parent_at(block, 2u)), read_above(block, slot, parent_at(block, 3u)));
        sum = sum_of(sum, between_all(parents));
        continuing {
            s++;
            break if s >= group.slot_count;
        }
    }
    return all_by(sum, 1.0 / f32(group.slot_count));
}

fn probe_at(block: Block, corner: u32) -> vec2f {
    return block.position + vec2f(side_of(corner)) * level.spacing;
}

// Where rays of a probe end, if they go on for t1 from there.
fn aim_of(block: Block, corner: u32, parent: u32) -> vec2f {
    if (MERGE == BILINEAR_FIX) {
        return probe_position(parent_at(block, parent), 2.0 * level.spacing);
    }
    if (MERGE == NEAREST_FIX) { // the nearest parent of a probe is the one at the same corner
        return probe_position(parent_at(block, corner), 2.0 * level.spacing);
    }
    return probe_at(block, corner);
}

// From the probe's t0 to t1 along the way from its aim; then what is behind.
fn trace_probe(block: Block, group: Group, corner: u32, parent: u32, beyond: vec3f) -> vec3f {
    let start = probe_at(block, corner) + group.direction * level.t0;
    let seen = march(start, aim_of(block, corner, parent) + group.direction * level.t1, group.free, block.walk);
    return seen.radiance + seen.passed * beyond;
}

// Written out: what runs rays in lockstep takes longer for a loop.
fn trace(block: Block, group: Group, parent: u32, beyond: Four) -> Four {
    return Four(trace_probe(block, group, 0u, parent, beyond.a), trace_probe(block, group, 1u, parent, beyond.b),
                trace_probe(block, group, 2u, parent, beyond.c), trace_probe(block, group, 3u, parent, beyond.d));
}

// Rays of their own for a parent, which end where that parent's begin, so that the two join without a seam; weighted.
fn trace_to_parent(block: Block, group: Group, parent: u32) -> Four {
    let beyond = mean_above(block, group, parent_at(block, parent));
    let light = trace(block, group, parent, Four(beyond, beyond, beyond, beyond));
    let is_upper = side_of(parent) == vec2i(1);
    let lower = select(vec2f(1.0 - LOWER_SHARE), vec2f(LOWER_SHARE), is_upper); // for lower probes
    let upper = select(vec2f(1.0 - UPPER_SHARE), vec2f(UPPER_SHARE), is_upper);
    return Four(light.a * (lower.x * lower.y * group.share), light.b * (upper.x * lower.y * group.share),
                light.c * (lower.x * upper.y * group.share), light.d * (upper.x * upper.y * group.share));
}

fn trace_to_all_parents(sum: Four, block: Block, group: Group) -> Four {
    var light = sum;
    var parent = 0u;
    loop {
        light = sum_of(light, trace_to_parent(block, group, parent));
        continuing {
            parent++;
            break if parent >= CORNERS;
        }
    }
    return light;
}

fn light_behind(block: Block, group: Group) -> Four {
    if (MERGE == BILINEAR) {
        return mean_between(block, group);
    }
    if (MERGE == NEAREST_FIX) {
        return Four(mean_above(block, group, parent_at(block, 0u)), mean_above(block, group, parent_at(block, 1u)),
                    mean_above(block, group, parent_at(block, 2u)), mean_above(block, group, parent_at(block, 3u)));
    }
    return Four(sky, sky, sky, sky);
}

fn add_group(sum: Four, block: Block, group: Group) -> Four {
    if (MERGE == BILINEAR_FIX) {
        return trace_to_all_parents(sum, block, group);
    }
    return sum_of(sum, all_by(trace(block, group, 0u, light_behind(block, group)), group.share));
}

fn trace_item(item: Near, wanted: bool) {
    let block = block_of(item.item);
    let step = arcStep(level.number, rule);
    var sum = Four(vec3f(0.0), vec3f(0.0), vec3f(0.0), vec3f(0.0));
    var j = 0u;
    loop {
        sum = add_group(sum, block, group_from(block.slot * BRANCHING + j, step, item.free));
        continuing {
            j += step;
            break if j >= BRANCHING;
        }
    }
    _ = keep_all(block, sum, wanted);
}

@compute @workgroup_size(GROUP)
fn solve(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) groups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    let count = counters[2u * level.number + 1u];
    var i = item_of(workgroup, groups, local);
    loop {
        trace_item(near[i], i < count);
        continuing {
            i += groups.x * groups.y * GROUP;
            break if i >= count;
        }
    }
}
