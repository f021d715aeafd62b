// What the transfer function makes of a way on which x goes evenly from one value to another: the emission-absorption integral.
// Twin: `Absorber::ramp` in src/truth/exact.rs. Needs transfer.glsl, opacity.glsl and logarithm.glsl.
//
// A way is cut where the transfer function bends, and where the transparency would change by more than a fifth of its mean to each side,
// the optical depth be above 1, or the extinction change by more than EVEN_DEPTH: most ways through cells are cut nowhere. Over a part
// opacities are linear, so that its optical depth has a closed form, of which a few terms of a series are exact to f32; what a change of
// colour brings has a series too, in the depth and of the first order in the change of the extinction.

// Red, green and blue are the same everywhere.
layout(constant_id = 40) const bool ONE_COLOR = false;

// An optical depth that lets nothing pass.
const float OPAQUE_DEPTH = 1.0e30;

// What is left to pass that nobody sees.
const float BLACK = 1.0e-8;

// Where the last piece ends: beyond every value.
const float ENDLESS_PIECE = 3.0e38;

// Parts of a way at the most: transparencies down to the least number of f32 are a hundredth each of the one before at worst.
const int MOST_PARTS = 1024;

// The most that the extinction of a part changes by, in depths: what is left out of the series is a part of some 4e-6 of the change of
// colour then.
const float EVEN_DEPTH = 0.03;

// The integral of exp(-tau(t)) - exp(-tau(1)) over a part of the optical depth tau(1) = `depth`, about 1 at the most, where the extinction goes
// evenly by `change` in all, in depths: series in the depth, and of the first order in the change.
float even_rise(float depth, float change) {
    float even = depth * (0.5 + depth * (-1.0 / 3.0 + depth * (0.125 + depth * (-1.0 / 30.0 + depth * (1.0 / 144.0 + depth * (-1.0 / 840.0 + depth / 5760.0))))));
    float first = 1.0 / 6.0 + depth * (-1.0 / 12.0 + depth * (1.0 / 40.0 + depth * (-1.0 / 180.0 + depth * (1.0 / 1008.0 - depth / 6720.0))));
    return even + 0.5 * change * first;
}

// The mean of -ln(1 - opacity) over a part where the opacity goes evenly from `a` to `b`; `clear` is 1 - opacity at both ends.
float mean_extinction(float a, float b, vec2 clear) {
    float sum = clear.x + clear.y;
    if (sum <= 0.0) {
        return OPAQUE_DEPTH;
    }
    float mean = 0.5 * (a + b);
    float ratio = (a - b) / sum;
    float square = ratio * ratio;
    float series = square * (1.0 / 6.0 + square * (1.0 / 20.0 + square * (1.0 / 42.0 + square / 72.0)));
    // ln(1 + x) by the series of the inverse hyperbolic tangent, or of the number itself.
    float logarithm_of_mean = mean <= 0.5 ? log_1_plus(-mean) : logarithm(max(0.5 * sum, 1.0e-37));
    return series - logarithm_of_mean;
}

float opacity_of(float optical_depth) {
    return optical_depth <= 0.5 ? -exp_minus_1(-optical_depth) : 1.0 - exp(-optical_depth);
}

// Premultiplied colour and opacity of a part of so many reference lengths.
vec4 over_part(vec4 first, vec4 last, vec2 clear, float lengths) {
    float depth = lengths * mean_extinction(first.a, last.a, clear);
    vec4 light = vec4(first.rgb, 1.0) * opacity_of(depth);
    if (!ONE_COLOR) {
        // What the extinction changes by: ln of the ratio of transparencies.
        float ratio = (first.a - last.a) / max(clear.x + clear.y, 1.0e-37);
        float change = -2.0 * ratio * (1.0 + ratio * ratio / 3.0);
        // Behind a part that nothing passes there is nothing to add.
        light.rgb += (last.rgb - first.rgb) * (depth <= 2.0 ? even_rise(depth, change * lengths) : 0.0);
    }
    return light;
}

// The piece in which a way goes on from a value: at a jump the later piece begins there, or ends. `above` is where the next one begins.
Piece piece_ahead(float value, bool falls, out float above) {
    above = ENDLESS_PIECE;
#ifdef FEW_PIECES
    vec4 place = transfer_rows[0];
    vec4 first = transfer_rows[1];
    vec4 second = transfer_rows[ROWS - 1];
    for (int row = ROWS; row < PIECES * ROWS; row += ROWS) {
        float begin = transfer_rows[row].x;
        if (falls ? value > begin : value >= begin) {
            place = transfer_rows[row];
            first = transfer_rows[row + 1];
            second = transfer_rows[row + ROWS - 1];
        } else {
            above = min(above, begin);
        }
    }
    return piece_of_rows(place, first, second);
#else
    int found = 0;
    for (int width = SEARCH; width > 0; width >>= 1) {
        if (found + width < PIECES) {
            float begin = transfer.rows[(found + width) * ROWS].x;
            found += (falls ? value > begin : value >= begin) ? width : 0;
        }
    }
    if (found + 1 < PIECES) {
        above = transfer.rows[(found + 1) * ROWS].x;
    }
    return piece_at(found);
#endif
}

// The part of a way of `left_over` reference lengths from `at` to `back` that is integrated as one: where it ends, how much of the way it
// is, and the light.
struct Part {
    float to;
    float share;
    vec4 light;
};

Part part_from(float at, float back, float left_over) {
    bool falls = back < at;
    float above;
    Piece piece = piece_ahead(at, falls, above);
    // Before the first bend the transfer function is what it is there.
    bool before = falls ? at <= piece.begin : at < piece.begin;
    float end = falls ? (before ? back : max(piece.begin, back)) : min(before ? piece.begin : above, back);
    float weight = clamp((at - piece.begin) * piece.inverse_length, 0.0, 1.0);
    float clear = max(piece.clear + weight * piece.clear_change, 0.0);
    vec4 first = piece.rgba + weight * piece.change;
    // The change of transparency with x, and how far x may go.
    float slope = before ? 0.0 : abs(piece.clear_change * piece.inverse_length);
    float way = abs(back - at);
    float step = min(abs(end - at), max(0.4 * clear, 1.0e-6) / max(slope, 1.0e-30));
    float share = way > 0.0 ? min(step / way, 1.0) : 1.0;
    bool to_end = step == abs(end - at);
    if (!ONE_COLOR) {
        // No less than -ln(clear), which is four times that of its fourth root r, and that no more than (1 - r) / sqrt(r).
        float root = sqrt(sqrt(max(clear, 1.0e-12)));
        float steep = slope * step / max(clear, 1.0e-6);
        float extinction = 4.0 * (1.0 - root) * inversesqrt(root) + 1.3 * steep;
        float change = max(steep * left_over, 1.0e-30);
        float longest = min(1.0 / max(extinction * left_over, 1.0e-30), inversesqrt(change / (EVEN_DEPTH * share)));
        to_end = to_end && share <= longest;
        share = min(share, longest);
    }
    Part part;
    part.share = share;
    part.to = share >= 1.0 ? back : to_end ? end : at + (falls ? -share : share) * way;
    part.to = part.to == at ? end : part.to;
    float weight_to = clamp((part.to - piece.begin) * piece.inverse_length, 0.0, 1.0);
    vec2 clears = vec2(clear, max(piece.clear + weight_to * piece.clear_change, 0.0));
    part.light = over_part(first, piece.rgba + weight_to * piece.change, clears, share * left_over);
    return part;
}

// Premultiplied colour and opacity of a way of so many reference lengths on which x goes evenly from `front` to `back`.
vec4 cell_integral(float front, float back, float lengths) {
    vec4 light = vec4(0.0);
    float at = front;
    float left_over = lengths;
    // Asked at the end as well: segment.glsl.
    for (int i = 0; i < MOST_PARTS && left_over > 0.0; ++i) {
        Part part = part_from(at, back, left_over);
        light = composite(light, part.light);
        at = part.to;
        left_over = part.share >= 1.0 ? 0.0 : left_over * (1.0 - part.share);
        if (left_over <= 0.0 || light.a >= 1.0 - BLACK) {
            break;
        }
    }
    return light;
}
