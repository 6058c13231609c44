// A level of cascades, first half: what probes have where their rays meet nothing, and a list of where they may meet
// something. trace.wgsl goes through the list.

const SHORTEST_MOVE: f32 = 8.0; // of a beam [px]; more than the reach of level 0, whose rays go all ways

@group(0) @binding(7) var<storage, read_write> counters: array<atomic<u32>>; // [level][2]: rays, and items of `near`
@group(0) @binding(11) var<storage, read_write> near: array<Near>; // in any order

// The share of their way on which rays of a slot of a block meet nothing: 1 where they meet nothing at all. A beam, wide
// enough for all of them, is moved forward as long as there is room for it.
fn free_share(block: Block) -> f32 {
    let walk = block.walk;
    let middle = block.position + 0.5 * level.spacing;
    let direction = directions[level.first_direction + BRANCHING * (2u * block.slot + 1u)];
    let reach = level.t1 - level.t0;
    let start = middle + direction * level.t0;
    var t = 0.0;
    var goes_on: bool;
    loop {
        let at = start + t * direction;
        let radius = level.radius + t * level.widening;
        let room = textureSampleLevel(grid, nearest, (floor(at) + 1.5) * walk.texel, 0.0).w - TWO_HALF_DIAGONALS;
        let landed = t + (room - radius) / (1.0 + level.widening);
        let leaves = !ENTERS & (any(at < vec2f(-radius)) | any(at > walk.size + radius));
        goes_on = (landed >= min(t + SHORTEST_MOVE, reach)) & !leaves;
        t = select(select(t, landed, goes_on), reach, leaves);
        continuing {
            break if !(goes_on & (t < reach));
        }
    }
    return min(t / reach, 1.0);
}

// What all rays of the slot see of a parent together: the mean of the slots above that continue them.
fn mean_above(block: Block, parent: vec2i) -> vec3f {
    let first = block.slot * BRANCHING;
    return 0.25 * (read_above(block, first, parent) + read_above(block, first + 1u, parent) +
                   read_above(block, first + 2u, parent) + read_above(block, first + 3u, parent));
}

// However rays are aimed, where they meet nothing it comes to the weights of the parents.
fn light_of_clear(block: Block) -> Four {
    if (MERGE == TOP) {
        return Four(sky, sky, sky, sky);
    }
    let parents = Four(mean_above(block, parent_at(block, 0u)), mean_above(block, parent_at(block, 1u)),
                       mean_above(block, parent_at(block, 2u)), mean_above(block, parent_at(block, 3u)));
    if (MERGE == NEAREST_FIX) {
        return parents;
    }
    return between_all(parents);
}

@compute @workgroup_size(GROUP)
fn merge(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) groups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    let item = item_of(workgroup, groups, local);
    if (item >= item_count()) {
        return;
    }
    let block = block_of(item);
    let probes = keep_all(block, light_of_clear(block), true);
    let aims = select(1u, CORNERS, MERGE == BILINEAR_FIX);
    atomicAdd(&counters[2u * level.number], probes * aims * (BRANCHING / arcStep(level.number, rule)));
    let free = free_share(block);
    if (free < 1.0) {
        near[atomicAdd(&counters[2u * level.number + 1u], 1u)] = Near(item, free);
    }
}
