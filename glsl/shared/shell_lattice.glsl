// The lattice of a shell that is closed at the faces of the volume, 32 nodes of a row in a word; slice.cells_* are its nodes. The nodes on
// each side are one more for the face of the volume, where the value of the outermost voxel stays what it is, and another one in the same
// place that is below every level. The Rust side is src/scene/shells/lattice.rs and crossings.rs.

#include "shared/slice.glsl"

// Nodes on each side that are no voxels.
const int MARGIN = 2;

// Entries of shell_sums that one invocation sums up (`SUMMED` in src/resource/shells.rs).
const uint SUMMED = 64u;

struct Word {
    // Its place in the row.
    uint at;
    uint y;
    uint z;
};

Word word_at(uint index) {
    uint in_row = words(slice.cells_x);
    uint row = index / in_row;
    return Word(index % in_row, row % slice.cells_y, row / slice.cells_y);
}

uint index_of(Word word) {
    return (word.z * slice.cells_y + word.y) * words(slice.cells_x) + word.at;
}
