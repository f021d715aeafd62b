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
// FEW_PIECES: in a uniform buffer, whose rows are the same in all invocations, where drivers of CPUs read those of a storage buffer
// invocation by invocation. They are read once, before the loop over samples: such drivers do not take reading out of loops.
#ifdef FEW_PIECES
// FEW_ROWS in src/shared/mod.rs.
layout(set = 0, binding = 5, std140) uniform Transfer {
    vec4 rows[48];
} transfer;
vec4 transfer_rows[48] = transfer.rows;
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

// Of two rows where they are grey.
Piece piece_of_rows(vec4 place, vec4 first, vec4 second) {
    vec4 rgba = GREY ? first.xxxy : first;
    vec4 change = GREY ? first.zzzw : second;
    return Piece(rgba, change, place.x, place.y, place.z, place.w);
}

#ifndef FEW_PIECES
Piece piece_at(int at) {
    return piece_of_rows(transfer.rows[at * ROWS], transfer.rows[at * ROWS + 1], transfer.rows[at * ROWS + ROWS - 1]);
}
#endif

// The piece of a value: at a jump the later one; clamped outside.
Piece piece_of(float value) {
#ifdef FEW_PIECES
    vec4 place = transfer_rows[0];
    vec4 first = transfer_rows[1];
    vec4 second = transfer_rows[ROWS - 1];
    for (int row = ROWS; row < PIECES * ROWS; row += ROWS) {
        if (value >= transfer_rows[row].x) {
            place = transfer_rows[row];
            first = transfer_rows[row + 1];
            second = transfer_rows[row + ROWS - 1];
        }
    }
    return piece_of_rows(place, first, second);
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
