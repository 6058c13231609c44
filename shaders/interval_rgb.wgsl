// T of holographic radiance cascades where a medium lets colours through differently: light, and three transmittances.
// interval_grey.wgsl is the same with one; a kernel is built with one of them.

struct Interval {
    light: vec3f,
    passed: vec3f,
}

fn interval_of(light: vec3f, through: vec3f) -> Interval {
    return Interval(light, through);
}

fn nothing() -> Interval {
    return Interval(vec3f(0.0), vec3f(1.0));
}

fn is_clear(a: Interval) -> bool {
    return all(a.light == vec3f(0.0)) & all(a.passed == vec3f(1.0));
}

fn light_of(a: Interval) -> vec3f {
    return a.light;
}

fn through(a: Interval, light: vec3f) -> vec3f {
    return a.passed * light;
}

fn choose(no: Interval, yes: Interval, which: bool) -> Interval {
    return Interval(select(no.light, yes.light, which), select(no.passed, yes.passed, which));
}

// Texels of one above the other.
const PLANES: i32 = 2;

fn interval_at(rows: texture_2d<f32>, at: vec2f, texel: vec2f) -> Interval {
    let passed = textureSampleLevel(rows, nearest, vec2f(at.x, at.y + texel.y), 0.0);
    return Interval(textureSampleLevel(rows, nearest, at, 0.0).rgb, passed.rgb);
}

// a, and b behind it.
fn compose(a: Interval, b: Interval) -> Interval {
    return Interval(a.light + a.passed * b.light, a.passed * b.passed);
}

fn mean_of(a: Interval, b: Interval) -> Interval {
    return Interval((a.light + b.light) * 0.5, (a.passed + b.passed) * 0.5);
}

fn parts_of(a: Interval, b: Interval, part_of_b: f32) -> Interval {
    let rest = 1.0 - part_of_b;
    return Interval(a.light * rest + b.light * part_of_b, a.passed * rest + b.passed * part_of_b);
}
