// What the transfer function makes of a way on which x goes evenly from one value to another: the emission-absorption integral.
// Twin: `Absorber::ramp` in src/truth/exact.rs. Needs transfer.glsl, opacity.glsl and logarithm.glsl.
//
// A way is cut where the transfer function bends, and where the transparency would change by more than a quarter of its mean to each side,
// the optical depth be above 1, or the extinction change by more than EVEN_DEPTH: most ways through cells are cut nowhere. Over a part
// opacities are linear, so that its optical depth has a closed form, of which a few terms of a series are exact to f32; what a change of
// colour brings has a series too, in the depth and of the first order in the change of the extinction.
//
// A part is tried as long as it may be, and a shorter one where it turns out too long: what tells it is known with its light.

// Red, green and blue are the same everywhere.
layout(constant_id = 40) const bool ONE_COLOR = false;

// No opacity is above one half, and no optical depth of a way.
layout(constant_id = 73) const bool SHALLOW = false;

// An optical depth that lets nothing pass, and one behind which nobody sees a change of colour.
const float OPAQUE_DEPTH = 1.0e30;
const float BLIND_DEPTH = 1.0e6;

// What is left to pass that nobody sees: of a way, and of all.
const float CLEAR_OF_PART = 1.0e-6;
const float BLACK = 1.0e-8;

// Where the last piece ends: beyond every value.
const float ENDLESS_PIECE = 3.0e38;

// Parts of a way that are tried at the most: transparencies down to the least number of f32 are a hundredth each of the one before at worst.
const int MOST_PARTS = 1024;

// The most that the transparency of a part changes by to each side, of its mean.
const float EVEN_CLEAR = 0.25;

// The most that the extinction of a part changes by, in depths: what is left out of the series is a part of some 4e-6 of the change of
// colour then.
const float EVEN_DEPTH = 0.03;

// How much shorter a part is tried than would just do if what it goes through changed evenly.
const float CAREFUL = 0.95;

// The least divisor.
const float LEAST = 1.0e-30;

// The integral of exp(-tau(t)) - exp(-tau(1)) over a part of the optical depth tau(1) = `depth`, about 1 at the most, where the extinction goes
// evenly by `change` in all, in depths: series in the depth, and of the first order in the change. Terms in pairs wait for each other less.
float even_rise(float depth, float change) {
    float square = depth * depth;
    float fourth = square * square;
    float even = ((0.5 - depth * (1.0 / 3.0)) + square * (0.125 - depth * (1.0 / 30.0)))
        + fourth * ((1.0 / 144.0 - depth * (1.0 / 840.0)) + square * (1.0 / 5760.0));
    float first = ((1.0 / 6.0 - depth * (1.0 / 12.0)) + square * (1.0 / 40.0 - depth * (1.0 / 180.0)))
        + fourth * (1.0 / 1008.0 - depth * (1.0 / 6720.0));
    return depth * even + 0.5 * change * first;
}

// The mean of -ln(1 - opacity) over a part where the opacity goes evenly, by `ratio` of the sum of transparencies to each side of its
// `mean`; `clear` is 1 - mean.
float mean_extinction(float mean, float clear, float ratio) {
    float square = ratio * ratio;
    float series = square * ((1.0 / 6.0 + square * (1.0 / 20.0)) + square * square * (1.0 / 42.0 + square * (1.0 / 72.0)));
    return series - (SHALLOW ? log_1_plus(-mean) : logarithm(max(clear, 1.0e-37), -mean));
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

// 1 - exp(-depth): the depth is so many times ln(2), in two parts, and a rest within half of that to each side.
float opacity_of(float depth) {
    if (SHALLOW) {
        return -exp_minus_1(-depth);
    }
    float seen = min(depth, 80.0);
    float halvings = floor(1.44269504 * seen + 0.5);
    float rest = (halvings * 0.693359375 - seen) - halvings * 2.12194440e-4;
    float left_over = uintBitsToFloat((127u - uint(halvings)) << 23);
    return (1.0 - left_over) - left_over * exp_minus_1(rest);
}

// A part of a way: its light, whether it is even enough for it, and how much longer one from the same place might be.
struct Part {
    vec4 light;
    bool even;
    float longer;
};

// Of so many reference lengths within a piece of the transfer function.
Part part_of(Piece piece, float from, float to, float lengths) {
    vec2 weights = clamp((vec2(from, to) - piece.begin) * piece.inverse_length, 0.0, 1.0);
    vec2 clears = max(piece.clear + weights * piece.clear_change, 0.0);
    vec4 first = piece.rgba + weights.x * piece.change;
    vec4 last = piece.rgba + weights.y * piece.change;
    float sum = clears.x + clears.y;
    float bend = abs(clears.y - clears.x);
    float ratio = (first.a - last.a) / max(sum, 1.0e-37);
    float depth = sum > 0.0 ? lengths * mean_extinction(0.5 * (first.a + last.a), 0.5 * sum, ratio) : OPAQUE_DEPTH;
    Part part;
    part.light = vec4(first.rgb, 1.0) * opacity_of(depth);
    part.even = bend <= max(EVEN_CLEAR * sum, CLEAR_OF_PART);
    float excess = bend / max(1.5 * EVEN_CLEAR * clears.x, CLEAR_OF_PART);
    if (!ONE_COLOR) {
        // What the extinction changes by: ln of the ratio of transparencies.
        float change = -2.0 * ratio * (1.0 + ratio * ratio / 3.0) * lengths;
        part.light.rgb += (last.rgb - first.rgb) * (depth <= 1.0 ? even_rise(depth, change) : 0.0);
        bool one_color = first.rgb == last.rgb;
        part.even = part.even && (one_color || ((depth <= 1.0 || depth >= BLIND_DEPTH) && abs(change) <= EVEN_DEPTH));
        excess = max(max(excess, depth), sqrt(abs(change) / EVEN_DEPTH));
    }
    part.longer = CAREFUL / max(excess, LEAST);
    return part;
}

// A way on which x goes evenly from `front` to `back`, and how far a ray has come on it.
struct EvenWay {
    float front;
    float back;
    // Reference lengths of all of it.
    float lengths;
    // x where the ray is, the share of the way that is behind it, and the share that is tried next at the most.
    float at;
    float gone;
    float most;
};

EvenWay even_way(float front, float back, float lengths) {
    return EvenWay(front, back, lengths, front, lengths > 0.0 ? 0.0 : 1.0, 1.0);
}

// Goes a part further: its premultiplied colour and opacity; nowhere, and nothing, where what was tried turns out too long.
vec4 next_part(inout EvenWay way) {
    bool falls = way.back < way.front;
    float rise = way.back - way.front;
    float above;
    Piece piece = piece_ahead(way.at, falls, above);
    // Before the first bend the transfer function is what it is there.
    bool before = falls ? way.at <= piece.begin : way.at < piece.begin;
    float end = falls ? (before ? way.back : max(piece.begin, way.back)) : min(before ? piece.begin : above, way.back);
    float share = end == way.back ? 1.0 : clamp((end - way.front) / rise, way.gone, 1.0);
    float most = way.gone + way.most;
    float shorter = way.front + most * rise;
    if (most < share && shorter != way.at) {
        share = most;
        end = shorter;
    }
    Part part = part_of(piece, way.at, end, (share - way.gone) * way.lengths);
    way.most = max((share - way.gone) * part.longer, LEAST);
    // What cannot be cut any more is even enough.
    bool taken = part.even || end == way.at || share == way.gone;
    way.at = taken ? end : way.at;
    way.gone = taken ? share : way.gone;
    return taken ? part.light : vec4(0.0);
}

// Premultiplied colour and opacity of a way of so many reference lengths on which x goes evenly from `front` to `back`.
vec4 cell_integral(float front, float back, float lengths) {
    vec4 light = vec4(0.0);
    EvenWay way = even_way(front, back, lengths);
    // Asked at the end as well: segment.glsl.
    for (int left_over = MOST_PARTS; left_over > 0 && way.gone < 1.0;) {
        light = composite(light, next_part(way));
        --left_over;
        if (left_over <= 0 || way.gone >= 1.0 || light.a >= 1.0 - BLACK) {
            break;
        }
    }
    return light;
}
