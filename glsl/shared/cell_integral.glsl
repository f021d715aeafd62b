// What the transfer function makes of a way on which x goes evenly from one value to another: the emission-absorption integral.
// Twin: `Absorber::ramp` in src/truth/exact.rs. Needs transfer.glsl, opacity.glsl and logarithm.glsl.
//
// Over a piece of the transfer function opacities are linear, so that the optical depth has a closed form. What a change of colour brings
// has none; it is the integral of a smooth function, by a rule of Gauss that is exact to f32 over the panels it is taken on.

// Beyond it nothing is seen.
const float OPAQUE_DEPTH = 1.0e30;

// The mean of -ln(1 - opacity) where the opacity goes evenly from `a` to `b`; `clear` is 1 - opacity at both.
float mean_extinction(float a, float b, vec2 clear) {
    float sum = clear.x + clear.y;
    if (sum <= 0.0) {
        return OPAQUE_DEPTH;
    }
    float ratio = (a - b) / sum;
    if (abs(ratio) > 0.25) {
        float product_x = clear.x > 0.0 ? clear.x * logarithm(clear.x) : 0.0;
        float product_y = clear.y > 0.0 ? clear.y * logarithm(clear.y) : 0.0;
        return 1.0 - (product_y - product_x) / (clear.y - clear.x);
    }
    float mean = 0.5 * (a + b);
    float square = ratio * ratio;
    float series = square * (1.0 / 6.0 + square * (1.0 / 20.0 + square * (1.0 / 42.0 + square / 72.0)));
    return series - (mean <= 0.5 ? log_1_plus(-mean) : logarithm(0.5 * sum));
}

float opacity_of(float optical_depth) {
    return optical_depth <= 0.5 ? -exp_minus_1(-optical_depth) : 1.0 - exp(-optical_depth);
}

// The integral of exp(-tau(t)) - exp(-tau(1)) over t from 0 to 1, where the opacity goes evenly from `a` to `b` and tau(1) is `whole`:
// what the change of a colour adds to the light, in parts of the change.
float rise_of(float a, float b, vec2 clear, float lengths, float whole) {
    // Points and weights of the rule of four points, on a panel from 0 to 1.
    const vec4 PLACES = vec4(0.0694318442, 0.3300094782, 0.6699905218, 0.9305681558);
    const vec4 WEIGHTS = vec4(0.1739274226, 0.3260725774, 0.3260725774, 0.1739274226);
    // Where it comes near to opaque the depth rises without bounds.
    bool steep = min(clear.x, clear.y) < 0.05;
    float panels = clamp(ceil(whole), steep ? 8.0 : 1.0, 16.0);
    float at_end = exp(-whole);
    float sum = 0.0;
    for (float panel = 0.0; panel < panels; panel += 1.0) {
        for (int i = 0; i < 4; ++i) {
            float t = (panel + PLACES[i]) / panels;
            float here = mix(a, b, t);
            float clear_here = mix(clear.x, clear.y, t);
            float depth = t * lengths * mean_extinction(a, here, vec2(clear.x, clear_here));
            sum += WEIGHTS[i] * (exp(-depth) - at_end);
        }
    }
    return sum / panels;
}

// Premultiplied colour and opacity of a way of so many reference lengths over one piece, from one x to another within it.
vec4 over_piece(Piece piece, float from, float to, float lengths) {
    vec2 weight = clamp((vec2(from, to) - piece.begin) * piece.inverse_length, 0.0, 1.0);
    vec4 first = piece.rgba + weight.x * piece.change;
    vec4 last = piece.rgba + weight.y * piece.change;
    vec2 clear = max(piece.clear + weight * piece.clear_change, 0.0);
    if (first.a <= 0.0 && last.a <= 0.0) {
        return vec4(0.0);
    }
    float depth = lengths * mean_extinction(first.a, last.a, clear);
    float opacity = opacity_of(depth);
    vec3 color = first.rgb * opacity;
    if (first.rgb != last.rgb) {
        color += (last.rgb - first.rgb) * rise_of(first.a, last.a, clear, lengths, depth);
    }
    return vec4(color, opacity);
}

// Premultiplied colour and opacity of a way of so many reference lengths on which x goes evenly from `front` to `back`.
vec4 cell_integral(float front, float back, float lengths) {
    if (!(lengths > 0.0)) {
        return vec4(0.0);
    }
    if (front == back) {
        return over_piece(piece_of(front), front, back, lengths);
    }
    float least = min(front, back);
    float most = max(front, back);
    bool falls = back < front;
    float scale = lengths / (most - least);
    vec4 light = vec4(0.0);
    // What lies before the first piece has its begin's colour.
    for (int i = 0; i <= PIECES; ++i) {
        int at = falls ? PIECES - i : i;
        Piece piece = piece_at(max(at - 1, 0));
        float low = at == 0 ? least : max(least, piece.begin);
        float high = at == PIECES ? most : min(most, at == 0 ? piece.begin : piece_at(at).begin);
        if (low < high) {
            float from = falls ? high : low;
            float to = falls ? low : high;
            light = composite(light, over_piece(piece, from, to, (high - low) * scale));
        }
    }
    return light;
}
