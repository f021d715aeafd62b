//! Opacity of a segment and front-to-back compositing. The GLSL twin is `glsl/shared/opacity.glsl`.

/// Opacity of a segment `exponent` reference lengths long whose opacity over one reference length is `alpha`:
/// `1 - (1 - alpha)^exponent`, without the cancellation that the plain form suffers for small `alpha`.
pub fn corrected_opacity(alpha: f64, exponent: f64) -> f64 {
    if alpha >= 1.0 {
        return if exponent > 0.0 { 1.0 } else { 0.0 };
    }
    -f64::exp_m1(exponent * f64::ln_1p(-alpha))
}

/// Extinction per reference length of a medium whose opacity over that length is `alpha`: `-ln(1 - alpha)`.
pub fn extinction(alpha: f64) -> f64 {
    -f64::ln_1p(-alpha)
}

/// Puts `behind` (premultiplied RGBA) under `front`: `front + (1 - front.a) * behind`.
pub fn composite(front: [f64; 4], behind: [f64; 4]) -> [f64; 4] {
    let transmittance = 1.0 - front[3];
    std::array::from_fn(|c| front[c] + transmittance * behind[c])
}
