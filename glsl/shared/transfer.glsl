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

// Of each piece (begin, inverse_length, clear, clear_change), then rgba and change, or both of grey and opacity in one.
//
// FEW_PIECES: in a uniform buffer, whose rows are the same in all invocations and are read once for them, where drivers of CPUs read
// those of a storage buffer invocation by invocation.
#ifdef FEW_PIECES
// FEW_ROWS in src/shared/mod.rs.
layout(set = 0, binding = 5, std140) uniform Transfer {
    vec4 rows[48];
} transfer;
#else
layout(set = 0, binding = 5, std430) readonly buffer Transfer {
    vec4 rows[];
} transfer;
#endif

// Pieces of the transfer function, the endless last one included.
layout(constant_id = 2) const int PIECES = 1;
// The first power of two that is not below PIECES, halved: where the search begins.
layout(constant_id = 3) const int SEARCH = 0;
// Red, green and blue are alike.
layout(constant_id = 14) const bool GREY = false;

// Rows of a piece.
const int ROWS = GREY ? 2 : 3;

Piece piece_at(int at) {
    vec4 place = transfer.rows[at * ROWS];
    vec4 first = transfer.rows[at * ROWS + 1];
    vec4 rgba = GREY ? first.xxxy : first;
    vec4 change = GREY ? first.zzzw : transfer.rows[at * ROWS + 2];
    return Piece(rgba, change, place.x, place.y, place.z, place.w);
}

// The piece of a value: at a jump the later one; clamped outside.
Piece piece_of(float value) {
#ifdef FEW_PIECES
    Piece piece = piece_at(0);
    for (int at = 1; at < PIECES; ++at) {
        Piece next = piece_at(at);
        if (value >= next.begin) {
            piece = next;
        }
    }
    return piece;
#else
    int at = 0;
    for (int width = SEARCH; width > 0; width >>= 1) {
        if (at + width < PIECES && value >= transfer.rows[(at + width) * ROWS].x) {
            at += width;
        }
    }
    return piece_at(at);
#endif
}

// Not premultiplied colour and opacity of a scalar value, and `clear`, 1 - opacity.
vec4 classify(float value, out float clear) {
    Piece piece = piece_of(value);
    float weight = max(value - piece.begin, 0.0) * piece.inverse_length;
    clear = fma(weight, piece.clear_change, piece.clear);
    return fma(vec4(weight), piece.change, piece.rgba);
}
