// Classification: the transfer function, piecewise linear, exactly (no table in between).
// Twin: src/scene/transfer.rs.

struct Piece {
    // Not premultiplied colour and opacity where the piece begins, and their change to its end.
    vec4 rgba;
    vec4 change;
    // Where the piece begins (units of the volume texture), and 1 / its length (0 for the last, endless one).
    float begin;
    float inverse_length;
    // 1 - opacity where the piece begins, and its change: f32 has no opacities next to 1, but next to 0.
    float clear;
    float clear_change;
};

layout(set = 0, binding = 5, std430) readonly buffer Transfer {
    Piece pieces[];
} transfer;

// Pieces of the transfer function, the endless last one included.
layout(constant_id = 2) const int PIECES = 1;
// The first power of two that is not below PIECES, halved: where the search begins.
layout(constant_id = 3) const int SEARCH = 0;

// Not premultiplied colour and opacity of a scalar value, and `clear`, 1 - opacity. At a jump the later point counts;
// clamped outside.
vec4 classify(float value, out float clear) {
    int at = 0;
    for (int width = SEARCH; width > 0; width >>= 1) {
        if (at + width < PIECES && value >= transfer.pieces[at + width].begin) {
            at += width;
        }
    }
    float weight = max(value - transfer.pieces[at].begin, 0.0) * transfer.pieces[at].inverse_length;
    clear = fma(weight, transfer.pieces[at].clear_change, transfer.pieces[at].clear);
    return fma(vec4(weight), transfer.pieces[at].change, transfer.pieces[at].rgba);
}
