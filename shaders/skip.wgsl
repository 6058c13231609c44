// The ARC paper's rule of ray skipping (src/cascade/skip.c): how many rays of a level one traced ray stands for.

struct SkipRule {
    start_level: u32,
    max_bits: u32, // 0: nothing is skipped
}

fn arcStep(level: u32, rule: SkipRule) -> u32 {
    if (rule.max_bits == 0u || level < rule.start_level) {
        return 1u;
    }
    return 1u << min(level - rule.start_level + 1u, rule.max_bits);
}
