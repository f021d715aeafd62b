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

/// How the numbers of an XML file are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Ascii,
    Base64,
    Zlib,
    AppendedRaw,
    AppendedBase64,
}

pub const FORMS: [Form; 5] = [Form::Ascii, Form::Base64, Form::Zlib, Form::AppendedRaw, Form::AppendedBase64];

/// The two cells as an XML file, in little-endian bytes where it has any.
pub fn xml(form: Form) -> Vec<u8> {
    use base64::Engine;
    let encode = |bytes: &[u8]| base64::engine::general_purpose::STANDARD.encode(bytes);
    let mut appended: Vec<u8> = Vec::new();
    let mut array = |kind: &str, name: &str, components: usize, numbers: &[f64]| -> String {
        let bytes: Vec<u8> = numbers
            .iter()
            .flat_map(|n| match kind {
                "Float32" => (*n as f32).to_le_bytes().to_vec(),
                "Float64" => n.to_le_bytes().to_vec(),
                "Int64" => (*n as i64).to_le_bytes().to_vec(),
                _ => vec![*n as u8],
            })
            .collect();
        let sized = [&(bytes.len() as u32).to_le_bytes()[..], &bytes].concat();
        let (format, text) = match form {
            Form::Ascii => {
                ("format=\"ascii\"".to_owned(), numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" "))
            }
            Form::Base64 => ("format=\"binary\"".to_owned(), encode(&sized)),
            Form::Zlib => {
                use std::io::Write;
                // Two parts, of which the last is shorter.
                let parts: Vec<&[u8]> = bytes.chunks(bytes.len().div_ceil(2).max(1)).collect();
                let packed: Vec<Vec<u8>> = parts
                    .iter()
                    .map(|part| {
                        let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
                        encoder.write_all(part).unwrap();
                        encoder.finish().unwrap()
                    })
                    .collect();
                let (whole, last) = (parts[0].len(), parts[parts.len() - 1].len());
                let last = if last == whole { 0 } else { last };
                let sizes = [parts.len(), whole, last].into_iter().chain(packed.iter().map(Vec::len));
                let sizes: Vec<u8> = sizes.flat_map(|size| (size as u32).to_le_bytes()).collect();
                ("format=\"binary\"".to_owned(), encode(&sizes) + &encode(&packed.concat()))
            }
            Form::AppendedRaw | Form::AppendedBase64 => {
                let offset = appended.len();
                appended.extend(if form == Form::AppendedRaw { sized } else { encode(&sized).into_bytes() });
                (format!("format=\"appended\" offset=\"{offset}\""), String::new())
            }
        };
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" {format}>{text}</DataArray>\n"
        )
    };
    let points = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 1., 1., 1.];
    let values = array("Float64", "heat", 1, &[1., 2., 3., 4., 5.])
        + &array("Float32", "flow", 3, &[3., 4., 0., 0., 0., 0., 1., 0., 0., 0., 0., 2., 0., 1., 0.])
        + &array("UInt8", "wet ness", 1, &[9., 8., 7., 6., 5.]);
    let of_cells = array("Float32", "order", 1, &[10., 20., 30.]);
    let points = array("Float32", "Points", 3, &points);
    let cells = array("Int64", "connectivity", 1, &[0., 1., 2., 3., 1., 2., 3., 4., 0., 1.])
        + &array("Int64", "offsets", 1, &[4., 8., 10.])
        + &array("UInt8", "types", 1, &[10., 10., 3.]);
    let packed = if form == Form::Zlib { " compressor=\"vtkZLibDataCompressor\"" } else { "" };
    let mut file = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\"{packed}>\n\
         <UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">\n<PointData>{values}</PointData><CellData>{of_cells}</CellData>\n\
         <Points>{points}</Points><Cells>{cells}</Cells></Piece></UnstructuredGrid>\n"
    )
    .into_bytes();
    if !appended.is_empty() {
        let encoding = if form == Form::AppendedRaw { "raw" } else { "base64" };
        file.extend(format!("<AppendedData encoding=\"{encoding}\">\n_").into_bytes());
        file.extend(appended);
        file.extend(b"\n</AppendedData>\n");
    }
    file.extend(b"</VTKFile>\n");
    file
}
