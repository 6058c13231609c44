// exp(-x) by the formula of src/kernel/exponential.h, so that media look the same wherever they are solved.

fn exp_negative(x: f32) -> f32 {
    if (!(x < 87.0)) {
        return 0.0;
    }
    let n = f32(i32(x * 1.44269504 + 0.5));
    let r = (x - n * 0.693359375) + n * 2.12194440e-4;
    var p = 1.0 / 720.0;
    p = 1.0 / 120.0 - r * p;
    p = 1.0 / 24.0 - r * p;
    p = 1.0 / 6.0 - r * p;
    p = 0.5 - r * p;
    p = 1.0 - r * p;
    p = 1.0 - r * p;
    return p * bitcast<f32>(u32(127 - i32(n)) << 23u);
}
