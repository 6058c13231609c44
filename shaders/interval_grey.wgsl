// T of holographic radiance cascades where nothing tells colours apart: light in r, g, b and one transmittance in a.
// interval_rgb.wgsl is the same with three; a kernel is built with one of them.

alias Interval = vec4f;

fn interval_of(light: vec3f, through: vec3f) -> Interval {
    return vec4f(light, through.r);
}

fn nothing() -> Interval {
    return vec4f(0.0, 0.0, 0.0, 1.0);
}

fn is_clear(a: Interval) -> bool {
    return all(a == nothing());
}

fn light_of(a: Interval) -> vec3f {
    return a.rgb;
}

fn through(a: Interval, light: vec3f) -> vec3f {
    return a.a * light;
}

fn choose(no: Interval, yes: Interval, which: bool) -> Interval {
    return select(no, yes, which);
}

// Texels of one above the other.
const PLANES: i32 = 1;

fn interval_at(rows: texture_2d<f32>, at: vec2f, texel: vec2f) -> Interval {
    return textureSampleLevel(rows, nearest, at, 0.0);
}

// a, and b behind it.
fn compose(a: Interval, b: Interval) -> Interval {
    return vec4f(a.rgb + a.a * b.rgb, a.a * b.a);
}

fn mean_of(a: Interval, b: Interval) -> Interval {
    return (a + b) * 0.5;
}

fn parts_of(a: Interval, b: Interval, part_of_b: f32) -> Interval {
    return a * (1.0 - part_of_b) + b * part_of_b;
}
