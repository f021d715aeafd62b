//! A mesh of cells in every way that legacy files of VTK have.

/// Two cells, as text.
pub const TEXT: &str = "# vtk DataFile Version 3.0
two cells
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 float
0 0 0  1 0 0  0 1 0  0 0 1  1 1 1
CELLS 3 13
4 0 1 2 3
4 1 2 3 4
2 0 1
CELL_TYPES 3
10 10 3
POINT_DATA 5
SCALARS heat double 1
LOOKUP_TABLE default
1 2 3 4 5
VECTORS flow float
3 4 0  0 0 0  1 0 0  0 0 2  0 1 0
FIELD FieldData 1
wet%20ness 1 5 unsigned_char
9 8 7 6 5
CELL_DATA 3
SCALARS order int
LOOKUP_TABLE default
10 20 30
";

/// The same as bytes, of the version that has offsets of cells.
pub fn bytes() -> Vec<u8> {
    let mut file =
        b"# vtk DataFile Version 5.1\ntwo cells\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n".to_vec();
    let points: [f32; 15] = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 1., 1., 1.];
    file.extend(points.iter().flat_map(|c| c.to_be_bytes()));
    file.extend(b"\nMETADATA\nINFORMATION 0\n\nCELLS 4 10\nOFFSETS vtktypeint64\n");
    file.extend([0i64, 4, 8, 10].iter().flat_map(|c| c.to_be_bytes()));
    file.extend(b"\nCONNECTIVITY vtktypeint64\n");
    file.extend([0i64, 1, 2, 3, 1, 2, 3, 4, 0, 1].iter().flat_map(|c| c.to_be_bytes()));
    file.extend(b"\nCELL_TYPES 3\n");
    file.extend([10i32, 10, 3].iter().flat_map(|c| c.to_be_bytes()));
    file.extend(b"\nPOINT_DATA 5\nSCALARS heat double\nLOOKUP_TABLE default\n");
    file.extend([1f64, 2., 3., 4., 5.].iter().flat_map(|c| c.to_be_bytes()));
    file.extend(b"\nMETADATA\nINFORMATION 0\n\nVECTORS flow float\n");
    let flow: [f32; 15] = [3., 4., 0., 0., 0., 0., 1., 0., 0., 0., 0., 2., 0., 1., 0.];
    file.extend(flow.iter().flat_map(|c| c.to_be_bytes()));
    file.extend(b"\nFIELD FieldData 1\nwet%20ness 1 5 unsigned_char\n");
    file.extend([9u8, 8, 7, 6, 5]);
    file.extend(b"\nCELL_DATA 3\nSCALARS order int\nLOOKUP_TABLE default\n");
    file.extend([10i32, 20, 30].iter().flat_map(|c| c.to_be_bytes()));
    file.push(b'\n');
    file
}

/// Eight points in rows, and along axes of their own.
pub const STRUCTURED: &str = "# vtk DataFile Version 2.0
a box
ASCII
DATASET STRUCTURED_GRID
DIMENSIONS 2 2 2
POINTS 8 double
0 0 0 1 0 0 0 1 0 1 1 0 0 0 2 1 0 2 0 1 2 1 1 2
POINT_DATA 8
SCALARS x float
0 1 0 1 0 1 0 1
";

pub const RECTILINEAR: &str = "# vtk DataFile Version 2.0
a box
ASCII
DATASET RECTILINEAR_GRID
DIMENSIONS 2 2 2
X_COORDINATES 2 float
0 1
Y_COORDINATES 2 float
0 1
Z_COORDINATES 2 float
0 2
POINT_DATA 8
SCALARS x float
0 1 0 1 0 1 0 1
";
