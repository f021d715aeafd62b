//! Readers of meshes of cells: what is written comes back in every form, what is wrong is refused by name.

use depthleap::Result;
use depthleap::read;
use depthleap::scene::settings::{Component, Settings};
use depthleap::scene::tetrahedra::Grid;

use crate::cell_samples::{FORMS, Form, RECTILINEAR, STRUCTURED, TEXT, bytes, xml};
use crate::kit::file;

fn read_with(bytes: &[u8], array: Option<&str>, component: Option<Component>) -> Result<Grid> {
    let (_folder, path) = file("a.vtk", bytes);
    read::tetrahedra(&path, array, component).map(|grid| grid.expect("a mesh of cells"))
}

fn read_as(bytes: &[u8]) -> Grid {
    read_with(bytes, None, None).unwrap_or_else(|e| panic!("{e}"))
}

fn refusal(bytes: &[u8]) -> String {
    match read_with(bytes, None, None) {
        Ok(grid) => panic!("read {} cells of {:?}", grid.cells.len(), String::from_utf8_lossy(bytes)),
        Err(error) => error.to_string(),
    }
}

/// The text with a part replaced, which has to be there.
fn changed(from: &str, to: &str) -> Vec<u8> {
    assert!(TEXT.contains(from), "{from}");
    TEXT.replacen(from, to, 1).into_bytes()
}

#[test]
fn text_and_bytes_of_both_versions_are_one_mesh() {
    let (text, bytes) = (read_as(TEXT.as_bytes()), read_as(&bytes()));
    assert_eq!((&text.points, &text.cells, &text.values), (&bytes.points, &bytes.cells, &bytes.values));
    assert_eq!(text.notes, bytes.notes);
    assert_eq!(text.cells, [[0, 1, 2, 3], [1, 2, 3, 4]]);
    assert_eq!(text.values, [1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(text.points[4], [1.0; 3]);
    assert_eq!(
        text.notes,
        [
            "of several arrays of values heat is shown; the others are flow, wet ness, order",
            "1 cells without a volume (points, lines, polygons) were left out"
        ]
    );
    let windows = TEXT.replace('\n', "\r\n");
    assert_eq!(read_as(windows.as_bytes()).values, text.values);
}

#[test]
fn arrays_are_chosen_by_name_and_component() {
    let of = |array: &str, component| read_with(TEXT.as_bytes(), Some(array), component);
    assert_eq!(of("wet ness", None).unwrap().values, [9.0, 8.0, 7.0, 6.0, 5.0]);
    assert_eq!(of("flow", Some(Component::Magnitude)).unwrap().values, [5.0, 0.0, 1.0, 2.0, 1.0]);
    assert_eq!(of("flow", Some(Component::Number(1))).unwrap().values, [4.0, 0.0, 0.0, 0.0, 1.0]);
    // Points have the mean of the cells around them: of 10 and 30, of all, of 10 and 20, and of 20 alone.
    assert_eq!(of("order", None).unwrap().values, [20.0, 20.0, 15.0, 15.0, 20.0]);
    let says = |array: &str, component, what: &str| {
        let message = of(array, component).unwrap_err().to_string();
        assert!(message.contains(what), "{message}");
    };
    says("flow", None, "has 3 values each; give a number from 0 to 2, or magnitude");
    says("flow", Some(Component::Number(3)), "is 3, and the array `flow` has 3 values each");
    says("heat", Some(Component::Luminance), "is luminance");
    says("hart", None, "did you mean `heat`?");
    says("hart", None, "its arrays are `heat`, `flow`, `wet ness`, `order`");
}

#[test]
fn grids_in_rows_are_cut_into_tetrahedra() {
    for text in [STRUCTURED, RECTILINEAR] {
        let grid = read_as(text.as_bytes());
        assert_eq!(grid.cells.len(), 6);
        assert_eq!(grid.points[7], [1.0, 1.0, 2.0]);
        let mut settings = Settings::default();
        let (_folder, path) = file("a.vtk", text.as_bytes());
        settings.volume.path = Some(path);
        let scene = read::scene(&settings).unwrap();
        assert_eq!(scene.field.extent().to_array(), [0.5, 0.5, 1.0]);
        assert_eq!(scene.tetrahedra.unwrap().boundary.len(), 12);
    }
}

#[test]
fn what_a_file_promises_it_has_to_hold() {
    for (from, to, what) in [
        ("POINTS 5", "POINTS 1000000000", "promises 3000000000 numbers under POINTS, of at least 5999999999 bytes"),
        ("POINTS 5", "POINTS 18446744073709551615", "promises"),
        ("POINTS 5", "POINTS five", "has five behind POINTS, where a number of things stands"),
        ("CELLS 3 13", "CELLS 1000000000 13", "which are over in the cell 3 of 1000000000"),
        ("CELLS 3 13", "CELLS 3 1000000000", "promises 1000000000 numbers under CELLS"),
        ("4 1 2 3 4", "4 1 2 3 5", "has the cell 1 with the point 5, and there are 5 points"),
        ("4 1 2 3 4", "4 1 2 3 -4", "has -4 where a point or a number of points stands"),
        ("4 1 2 3 4", "4 1 2 3 0.5", "has 0.5 where a point"),
        ("CELL_TYPES 3\n10 10 3", "CELL_TYPES 2\n10 10", "has 3 CELLS and 2 CELL_TYPES"),
        ("10 10 3", "10 24 3", "has the cell 1 of the kind 24, which is not linear"),
        ("10 10 3", "10 12 3", "has the cell 1 with 4 corners, and a hexahedron has 8"),
        ("10 10 3", "10 -1 3", "has the cell 1 of the kind -1, which there is not"),
        ("10 10 3", "3 3 3", "has no cells with a volume"),
        ("ASCII", "EBCDIC", "has `EBCDIC` in line 3, where ASCII or BINARY stands"),
        ("DATASET UNSTRUCTURED_GRID", "DATASET POLYDATA", "holds a dataset of the kind `POLYDATA`"),
        ("DATASET UNSTRUCTURED_GRID\n", "", "holds no DATASET"),
        ("double 1", "quadruple 1", "has numbers of the type `quadruple`"),
        ("1 2 3 4 5", "1 2 x 4 5", "has `x` in line 16, under heat"),
        ("POINT_DATA 5", "POINT_DATA 4", "has `5` in line"),
        ("POINT_DATA 5\n", "", "has the array `heat` before POINT_DATA or CELL_DATA"),
        ("0 0 0  1 0 0", "0 0 nan  1 0 0", "has the point 0"),
    ] {
        let mut settings = Settings::default();
        let (_folder, path) = file("a.vtk", &changed(from, to));
        settings.volume.path = Some(path);
        let message = read::scene(&settings).map(drop).unwrap_err().to_string();
        assert!(message.contains(what), "{from} -> {to}: {message}");
        assert!(message.contains("a.vtk"), "{message}");
    }
    assert!(
        refusal(STRUCTURED.replace("DIMENSIONS 2 2 2", "DIMENSIONS 2 2 3").as_bytes())
            .contains("[2, 2, 3] and 8 points")
    );
    assert!(
        refusal(STRUCTURED.replace("DIMENSIONS 2 2 2", "DIMENSIONS 1 4 2").as_bytes())
            .contains("no cells with a volume")
    );
    let wide = RECTILINEAR.replace("X_COORDINATES 2", "X_COORDINATES 4000000000");
    assert!(refusal(wide.as_bytes()).contains("promises 4000000000 numbers"));
}

#[test]
fn no_truncation_is_read_as_the_whole_or_worse() {
    for whole in [TEXT.as_bytes().to_vec(), bytes(), STRUCTURED.as_bytes().to_vec(), RECTILINEAR.as_bytes().to_vec()] {
        let cells = read_as(&whole).cells.len();
        for length in 0..whole.len() {
            let (_folder, path) = file("a.vtk", &whole[..length]);
            match read::tetrahedra(&path, None, None) {
                // Values behind the ones that are shown may lack.
                Ok(Some(grid)) => assert_eq!(grid.cells.len(), cells, "{length}"),
                Ok(None) => assert!(length < 30, "{length} bytes are not recognised"),
                Err(error) => assert!(error.to_string().contains("a.vtk"), "{error}"),
            }
        }
    }
}

#[test]
fn values_that_are_none_are_replaced_left_out_or_refused() {
    let (_folder, path) = file("a.vtk", &changed("1 2 3 4 5", "nan 2 3 4 5"));
    let of = |nan| {
        let mut settings = Settings::default();
        (settings.volume.path, settings.volume.nan) = (Some(path.clone()), nan);
        read::scene(&settings)
    };
    use depthleap::scene::field::NanPolicy::{Error, Hole, Replace};
    let replaced = of(Replace).unwrap();
    assert_eq!((replaced.field.range, replaced.field.missing), ([2.0, 5.0], 1));
    assert_eq!(replaced.tetrahedra.unwrap().cells.len(), 2);
    assert_eq!(of(Hole).unwrap().tetrahedra.unwrap().cells.len(), 1);
    assert!(of(Error).unwrap_err().to_string().contains("1 points whose values are NaN"));
}

#[test]
fn xml_in_every_form_is_the_same_mesh() {
    let text = read_as(TEXT.as_bytes());
    for form in FORMS {
        let grid = read_as(&xml(form));
        assert_eq!((&grid.points, &grid.cells, &grid.values), (&text.points, &text.cells, &text.values), "{form:?}");
        assert_eq!(grid.notes, text.notes, "{form:?}");
        let flow = read_with(&xml(form), Some("flow"), Some(Component::Magnitude)).unwrap();
        assert_eq!(flow.values, [5.0, 0.0, 1.0, 2.0, 1.0], "{form:?}");
    }
}

#[test]
fn pieces_that_meet_share_their_points() {
    let piece = |value: u32, x: [u32; 4]| {
        let points: Vec<String> =
            x.iter().zip(["0 0", "1 0", "0 1", "1 1"]).map(|(x, yz)| format!("{x} {yz}")).collect();
        let array = |name: &str, kind: &str, components: u32, text: &str| {
            format!(
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">{text}</DataArray>"
            )
        };
        format!(
            "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><CellData>{}</CellData><Points>{}</Points><Cells>{}{}{}</Cells></Piece>",
            array("v", "Float32", 1, &value.to_string()),
            array("p", "Float32", 3, &points.join(" ")),
            array("connectivity", "Int32", 1, "0 1 2 3"),
            array("offsets", "Int32", 1, "4"),
            array("types", "UInt8", 1, "10")
        )
    };
    let file = |pieces: &str| {
        format!(
            "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>{pieces}</UnstructuredGrid></VTKFile>"
        )
    };
    // They have the three points at x = 1 in common, and those the mean of both cells.
    let both = piece(2, [0, 1, 1, 1]) + &piece(4, [2, 1, 1, 1]);
    let grid = read_as(file(&both).as_bytes()).cleaned().unwrap();
    assert_eq!((grid.points.len(), grid.cells.len()), (5, 2));
    let mut values = grid.values.clone();
    values.sort_by(f64::total_cmp);
    assert_eq!(values, [2.0, 3.0, 3.0, 3.0, 4.0]);
    let unlike = both.replacen("Name=\"v\"", "Name=\"w\"", 1);
    assert!(refusal(file(&unlike).as_bytes()).contains("in some pieces and not in others"));
    let deep = format!("<VTKFile type=\"UnstructuredGrid\">{}", "<a b=\"/>\">".repeat(200_000));
    assert!(refusal(deep.as_bytes()).contains("more than 64 deep"));
}

#[test]
fn xml_that_is_cut_off_or_promises_too_much_is_refused() {
    for form in FORMS {
        let whole = xml(form);
        for length in 0..whole.len() {
            let (_folder, path) = file("a.vtk", &whole[..length]);
            match read::tetrahedra(&path, None, None) {
                // Behind what is appended nothing has to follow.
                Ok(Some(grid)) => assert_eq!(grid.cells.len(), 2, "{form:?}, {length}"),
                Ok(None) => assert!(length < 40, "{form:?}, {length} bytes are not recognised"),
                Err(error) => assert!(error.to_string().contains("a.vtk"), "{error}"),
            }
        }
    }
    let text = String::from_utf8(xml(Form::Ascii)).unwrap();
    for (from, to, what) in [
        (
            "NumberOfPoints=\"5\"",
            "NumberOfPoints=\"1000000000\"",
            "numbers in the array `Points` for 1000000000 times 3",
        ),
        ("NumberOfCells=\"3\"", "NumberOfCells=\"18446744073709551615\"", "for 18446744073709551615 times 1"),
        ("type=\"Float64\"", "type=\"Float16\"", "of the type `Float16`"),
        (
            "Name=\"offsets\" NumberOfComponents=\"1\"",
            "Name=\"offsets\" NumberOfComponents=\"0\"",
            "times 0 numbers in the array `offsets`",
        ),
        ("4 8 10", "4 8 11", "has offsets of cells that do not rise to 10"),
        ("4 8 10", "8 4 10", "has offsets of cells that do not rise to 10"),
        ("1 2 3 4 0 1", "1 2 3 5 0 1", "has the cell 1 with the point 4294967295, and there are 5 points"),
        ("Name=\"types\"", "Name=\"kinds\"", "has Cells without types"),
        ("type=\"UnstructuredGrid\"", "type=\"PolyData\"", "holds no `PolyData`"),
        ("byte_order", "compressor=\"vtkLZ4DataCompressor\" byte_order", "is packed by `vtkLZ4DataCompressor`"),
        ("</Points>", "", "is not XML"),
    ] {
        assert!(text.contains(from), "{from}");
        let message = refusal(text.replacen(from, to, 1).as_bytes());
        assert!(message.contains(what), "{from} -> {to}: {message}");
    }
}
