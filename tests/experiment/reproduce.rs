//! The papers' numbers against each other, and the comparison of synthetic counts with them.

use depthleap::experiment::reproduce::papers::{DATA_SETS, DataSet, FOV, PaperRow, VIEWPORT};
use depthleap::experiment::reproduce::stated::{contributing, stated_table};
use depthleap::experiment::reproduce::{
    FORMAT, FigureRecord, ReproducedSet, Reproduction, StatedRecord, Variant, csv, embedded_lines, embedded_verdict,
    lines, page, text, verdict,
};
use depthleap::measure::record::{CountsRecord, Ideal, LayerRecord, Run};
use depthleap::provenance::Provenance;
use depthleap::report::html::Png;
use depthleap::report::table::TextLayout;
use depthleap::scene::settings::{MeshSettings, PartialSegments};

use crate::runs::run;

fn set(name: &str) -> &'static DataSet {
    DATA_SETS.iter().find(|set| set.name == name).unwrap()
}

fn published(set: &DataSet, row: PaperRow) -> [u64; 2] {
    let found = set.rows.iter().find(|published| published.row == row).unwrap();
    [found.main, found.intermediate]
}

#[test]
fn percentages_printed_in_the_thesis_follow_from_its_counts() {
    let printed = [("MRI-Head", [86, 12]), ("Foot", [85, 22]), ("Engine", [60, 16]), ("Fuel", [52, 46])];
    for (name, percents) in printed {
        let (block, omni) = (published(set(name), PaperRow::Block), published(set(name), PaperRow::Omni));
        for kind in 0..2 {
            let percent = (100.0 * omni[kind] as f64 / block[kind] as f64).round() as u32;
            assert_eq!(percent, percents[kind], "{name}");
        }
    }
}

#[test]
fn block_skipping_runs_every_fragment_of_the_face_in_every_pass() {
    for set in DATA_SETS.iter().filter(|set| !set.rows.is_empty()) {
        let face = u64::from(set.face) * u64::from(set.face);
        assert_eq!(published(set, PaperRow::Block)[1], face * u64::from(set.intermediate_passes), "{}", set.name);
    }
}

#[test]
fn parts_sum_up_to_what_the_thesis_counted_with_geometry() {
    for (set, geometry) in DATA_SETS.iter().filter_map(|set| Some((set, set.geometry?))) {
        let theirs: Vec<_> = geometry.rows.iter().filter_map(|row| row.theirs).collect();
        for one in theirs.iter().filter(|one| !one.parts.is_empty()) {
            assert_eq!(one.parts.len(), geometry.parts as usize, "{}", set.name);
            for kind in 0..2 {
                assert_eq!(one.parts.iter().map(|part| part[kind]).sum::<u64>(), one.with[kind], "{}", set.name);
            }
        }
        let Some(early_z) = theirs.first() else { continue };
        let all = u64::from(set.face).pow(2) * u64::from(set.intermediate_passes);
        assert_eq!([early_z.without[1], early_z.with[1]], [all, all * u64::from(geometry.parts)], "{}", set.name);
    }
}

#[test]
fn the_geometry_of_the_tables_reads_and_has_its_volume() {
    for (set, geometry) in DATA_SETS.iter().filter_map(|set| Some((set, set.geometry?))) {
        let scene = depthleap::read::settings_of(set.name, geometry.scene.text, std::path::Path::new("")).unwrap();
        assert!(scene.meshes.iter().any(|mesh| mesh.opacity < 1.0), "{}: nothing is peeled", set.name);
        assert_eq!(scene.volume.path.as_deref(), set.file.map(std::path::Path::new));
    }
}

#[test]
fn faces_have_their_pixels_from_the_distance() {
    for set in &DATA_SETS {
        // The face lies half a side in front of the centre.
        let height = 2.0 * (set.distance() - 0.5) * (0.5 * FOV.to_radians()).tan();
        let pixels = f64::from(VIEWPORT) / height;
        assert!((pixels - f64::from(set.face)).abs() < 1.0, "{}: {pixels} from {}", set.name, set.distance());
    }
    assert_eq!(set("Engine").distance(), 1.91);
}

#[test]
fn passes_and_steps_fit_the_diagonal_of_the_cube() {
    for set in &DATA_SETS {
        let passes = (3f64.sqrt() / (8.0 * set.step)).ceil() as u32;
        assert_eq!(passes, set.intermediate_passes + 1, "{}", set.name);
    }
}

fn counted(method: &str, block_first: bool, main: u64, intermediate: u64) -> Run {
    let mut run = run(method, &[], &[]);
    run.fragments = CountsRecord { main, intermediate, ..CountsRecord::default() };
    run.settings.method.block_first = block_first;
    run.ideal = Some(Ideal { main: 10 });
    run
}

fn variant(choice: &str, omni: u64) -> Variant {
    let runs = vec![
        counted("rc-block", false, 1000, 2000),
        counted("rc-block", true, 500, 2100),
        counted("nn-omni", false, omni, 400),
    ];
    Variant { choice: choice.to_owned(), value: "<1>".to_owned(), runs }
}

/// With polygons, the parts of their rays having these fragments.
fn embedded(method: &str, main: [u64; 3], intermediate: [u64; 3]) -> Run {
    let mut run = counted(method, false, main.iter().sum(), intermediate.iter().sum());
    run.settings.meshes = vec![MeshSettings::default()];
    let parts = main.iter().zip(intermediate);
    run.fragments.per_layer =
        parts.map(|(main, intermediate)| LayerRecord { pixels: Some(1), main: *main, intermediate }).collect();
    run
}

/// With segments that end at a surface drawn apart.
fn apart(mut run: Run) -> Run {
    run.settings.layers.partial = PartialSegments::Apart;
    run
}

/// What is kept of a set with geometry.
fn counted_with_geometry(set: &DataSet) -> ReproducedSet {
    let runs = vec![
        counted("rc-block", false, 1000, 2000),
        counted("nn-omni", false, 500, 400),
        embedded("rc-block", [800, 100, 80], [2000, 2000, 2000]),
        embedded("nn-omni", [400, 50, 0], [390, 40, 10]),
        apart(embedded("nn-omni", [400, 50, 0], [350, 35, 5])),
    ];
    ReproducedSet {
        name: set.name.to_owned(),
        source: set.source.to_owned(),
        file: Some("foot_cadaver.nrrd".to_owned()),
        absent: None,
        picture: None,
        variants: vec![Variant { choice: "main".to_owned(), value: "as it is".to_owned(), runs }],
    }
}

/// With the foot of chapter 6 counted, and a figure drawn beside one that is absent.
fn found_with_geometry() -> Reproduction {
    let mut found = found();
    let place = DATA_SETS.iter().position(|set| set.name == "Foot with geometry").unwrap();
    found.columns[place] = counted_with_geometry(&DATA_SETS[place]);
    let figure = |about: &str, absent: Option<&str>| FigureRecord {
        scene: "engine-geometry".to_owned(),
        about: about.to_owned(),
        source: "Thesis ch. 6, Figure 3".to_owned(),
        file: None,
        absent: absent.map(str::to_owned),
        picture: absent.is_none().then(|| "pictures/figure.png".to_owned()),
        run: None,
    };
    found.figures = vec![figure("a sphere & an arrow", None), figure("a foot", Some("foot.nrrd is not there"))];
    found
}

#[test]
fn lines_with_geometry_have_every_layer_below_the_thesis_own() {
    let set = set("Foot with geometry");
    let (geometry, column) = (set.geometry.unwrap(), counted_with_geometry(set));
    let main = embedded_lines(&geometry, &column, true);
    let names: Vec<&str> = main.iter().map(|line| line.name).collect();
    assert_eq!(
        names,
        ["Early z", "rc-block", "Near neighbor", "nn-omni", "nn-omni (apart)"],
        "what was not counted is left out"
    );
    assert_eq!((main[0].without, main[0].with, main[0].row), (Some(394_987), Some(386_542), None));
    assert_eq!((main[1].without, main[1].with, main[1].ratio), (Some(1000), Some(980), Some(0.98)));
    assert_eq!((main[1].parts.as_slice(), main[1].share), ([800, 100, 80].as_slice(), Some(1.0)));
    assert_eq!((main[3].with, main[3].share), (Some(450), Some(450.0 / 980.0)), "to block skipping with geometry");
    assert!((main[3].their_ratio.unwrap() - 309_558.0 / 336_413.0).abs() < 1e-12);
    let intermediate = embedded_lines(&geometry, &column, false);
    assert_eq!((intermediate[1].with, intermediate[1].ratio), (Some(6000), Some(3.0)));
    assert_eq!((intermediate[4].without, intermediate[4].with), (Some(400), Some(390)), "to the plain form without");
    let verdict = embedded_verdict(&intermediate).unwrap();
    assert!(verdict.contains("rc-block 300.0 % of those without geometry, theirs 300.0 %"), "{verdict}");
    // Without polygons the same column has the counts of its first runs.
    let plain = lines(set, &column, true);
    assert!(plain.iter().any(|line| line.row == PaperRow::Omni && line.ours == Some(500)));
}

#[test]
fn geometry_and_figures_are_shown_and_written() {
    let found = found_with_geometry();
    let text = text(&found);
    assert!(
        text.contains("Near neighbor (thesis)") && text.contains("layer 2") && text.contains("29,675,808"),
        "{text}"
    );
    assert!(text.contains("Early z 89,603 / 489,268, with geometry 79,665 / 1,957,072"), "absent ones too: {text}");
    let page = page(&found, &|_| Ok(Png { bytes: vec![1], size: [2, 1] }));
    assert!(page.contains("<h2>Figures") && page.contains("After Thesis ch. 6, Figure 3: a sphere &amp; an arrow"));
    assert!(page.contains("a foot: foot.nrrd is not there") && page.matches("<img").count() == 2);
    let csv = csv(&found).unwrap();
    let mut reader = csv_reader(&csv);
    let rows: Vec<Vec<String>> = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
    let of = |row: &str| {
        let of_row = |line: &&Vec<String>| line[0] == "Foot with geometry" && line[3] == row && line[4] == "main";
        rows.iter().filter(of_row).map(|line| line[7..].join(" ")).collect::<Vec<_>>()
    };
    let omni = ["  500  without ", "  400  with 0", "  50  with 1", "  0  with 2", "  450 0.900000 with "];
    assert_eq!(of("nn-omni"), omni);
    let of_choice = |line: &&Vec<String>| line[3] == "rc-block" && line[11] == "with" && line[5] == "main";
    assert_eq!(rows.iter().filter(of_choice).count(), 2 * 4, "every count of ours has its choice");
    assert_eq!(of("Near neighbor")[..2], ["336413    without ", "281973    with 0"]);
}

#[test]
fn results_of_older_programs_are_read() {
    let mut old = serde_json::to_value(found()).unwrap();
    old.as_object_mut().unwrap().remove("figures");
    old["columns"].as_array_mut().unwrap().truncate(7);
    let old: Reproduction = serde_json::from_value(old).unwrap();
    assert!(old.figures.is_empty() && text(&old).contains("Engine (Thesis") && csv(&old).is_ok());
    assert!(!page(&old, &|_| Err("none".to_owned())).contains("<h2>Figures"));
}

/// Everything absent but Engine.
fn found() -> Reproduction {
    let column = |set: &DataSet| ReproducedSet {
        name: set.name.to_owned(),
        source: set.source.to_owned(),
        file: (set.name == "Engine").then(|| "engine_256cube.nrrd".to_owned()),
        absent: (set.name != "Engine").then(|| format!("no {} & nothing else", set.name)),
        picture: (set.name == "Engine").then(|| "pictures/engine.png".to_owned()),
        variants: if set.name == "Engine" { vec![variant("main", 600), variant("threshold T", 900)] } else { vec![] },
    };
    Reproduction {
        provenance: Provenance {
            version: FORMAT,
            program: "depthleap".to_owned(),
            commit: "none".to_owned(),
            command: "depthleap reproduce".to_owned(),
            date: "2026-01-01T00:00:00Z".to_owned(),
        },
        columns: DATA_SETS.iter().map(column).collect(),
        figures: Vec::new(),
        timed: None,
        stated: Some(stated()),
    }
}

fn engine(found: &Reproduction) -> &ReproducedSet {
    found.columns.iter().find(|column| column.name == "Engine").unwrap()
}

#[test]
fn lines_have_both_sides_and_the_range_of_the_sweep() {
    let found = found();
    let main = lines(set("Engine"), engine(&found), true);
    let omni = main.iter().find(|line| line.row == PaperRow::Omni).unwrap();
    assert_eq!((omni.theirs, omni.ours), (Some(186_059), Some(600)));
    assert_eq!((omni.our_ratio, omni.sweep), (Some(0.6), Some([0.6, 0.9])));
    assert!((omni.their_ratio.unwrap() - 0.602).abs() < 1e-3);
    let of = |row: PaperRow| main.iter().find(|line| line.row == row).map(|line| (line.theirs, line.ours));
    assert_eq!(of(PaperRow::Ideal), Some((None, Some(10))));
    assert_eq!(of(PaperRow::Directional), Some((Some(178_331), None)), "not counted here, and not made up");
    let intermediate = lines(set("Engine"), engine(&found), false);
    assert!(intermediate.iter().all(|line| line.row != PaperRow::Ideal), "the bound is one of main fragments");
    let absent = lines(set("Foot"), &found.columns[1], true);
    assert!(absent.iter().all(|line| line.ours.is_none() && line.sweep.is_none()) && absent.len() == 4);
}

/// Slices of which one in a hundred fragments contributes, and a propagation of which three passes in five have fragments.
fn stated() -> StatedRecord {
    let set = |name: &str, variants: Vec<Variant>| ReproducedSet {
        name: name.to_owned(),
        source: "a paper".to_owned(),
        file: Some("here".to_owned()),
        absent: None,
        picture: None,
        variants,
    };
    let variant =
        |value: &str, runs: Vec<Run>| Variant { choice: "a choice".to_owned(), value: value.to_owned(), runs };
    let slices = vec![counted("slices-3d", false, 1000, 0), counted("slices-3d+ftb", false, 400, 0)];
    let passes = || vec![run("tet-propagation", &[9, 4, 1, 0, 0], &[])];
    StatedRecord {
        slices: vec![set("Cube", vec![variant("surface", slices)])],
        propagation: set("Fin", vec![variant("read meanwhile", passes()), variant("none", passes())]),
    }
}

#[test]
fn what_is_stated_in_words_stands_beside_ours() {
    let stated = stated();
    let (part, all) = contributing(&stated.slices[0].variants[0]).unwrap();
    assert_eq!((part, all), (0.01, 1000));
    let text = stated_table(&stated, None).unwrap().text(&TextLayout::default());
    assert!(
        text.contains("Cube, surface") && text.contains("0.2 to 4 %") && text.contains("1.00 % of 1,000"),
        "{text}"
    );
    assert!(text.contains("3 of 5 passes have fragments"), "{text}");
    let nothing = ReproducedSet { variants: Vec::new(), ..stated.propagation };
    assert!(stated_table(&StatedRecord { slices: Vec::new(), propagation: nothing }, None).is_none());
}

#[test]
fn verdict_tells_near_from_far() {
    let found = found();
    let main = verdict(&lines(set("Engine"), engine(&found), true)).unwrap();
    assert_eq!(main, "within a factor of 1.5: nn-omni 60.0 % of block skipping, theirs 60.2 %.");
    let mut far = found.clone();
    far.columns[2].variants[0].runs[2].fragments.main = 100;
    let far = verdict(&lines(set("Engine"), engine(&far), true)).unwrap();
    assert!(far.starts_with("further apart: nn-omni 10.0 %") && far.contains("within the sweep"), "{far}");
    assert_eq!(verdict(&lines(set("Foot"), &found.columns[1], true)), None);
}

#[test]
fn text_and_page_show_what_is_there_and_then_what_is_absent() {
    let found = found();
    let text = text(&found);
    let at = |part: &str| text.find(part).unwrap_or_else(|| panic!("no {part} in {text}"));
    assert!(at("Engine (Thesis") == 0 && at("186,059") < at("Absent"), "{text}");
    assert!(at("60.0 to 90.0") < at("Absent") && at("Absent") < at("What the thesis leaves open"), "{text}");
    let absent: Vec<&str> = text.lines().filter(|line| line.contains("& nothing else")).collect();
    assert_eq!(absent.len(), DATA_SETS.len() - 1, "a line each: {text}");
    assert!(absent[1].contains("Foot: no Foot & nothing else (Thesis"), "{}", absent[1]);
    assert!(absent[1].contains("rc-block 538,173 / 9,891,936"), "what the thesis counted: {}", absent[1]);
    let page = page(&found, &|_| Ok(Png { bytes: vec![1], size: [2, 1] }));
    assert!(page.contains("no Foot &amp; nothing else") && page.contains("&lt;1&gt;") && !page.contains("<1>"));
    assert_eq!(page.matches("<img").count(), 1);
    assert!(page.find("<h2>Engine").unwrap() < page.find("<h2>Absent").unwrap());
}

#[test]
fn csv_has_a_line_for_every_number() {
    let found = found();
    let text = csv(&found).unwrap();
    let mut reader = csv_reader(&text);
    let rows: Vec<Vec<String>> = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
    let omni: Vec<&Vec<String>> =
        rows.iter().filter(|row| row[0] == "Engine" && row[3] == "nn-omni" && row[4] == "main").collect();
    assert_eq!(omni.len(), 2);
    assert_eq!(omni[0][7..11], ["186059", "0.601944", "600", "0.600000"]);
    assert_eq!(omni[1][5..7], ["threshold T", "<1>"]);
    assert_eq!(omni[1][10], "0.900000");
    assert!(rows.iter().any(|row| row[0] == "Foot" && row[9].is_empty() && row[7] == "538173"));
}

fn csv_reader(text: &str) -> ::csv::Reader<&[u8]> {
    ::csv::Reader::from_reader(text.as_bytes())
}

#[test]
fn json_comes_back_as_it_was() {
    let found = found();
    let text = serde_json::to_string(&found).unwrap();
    assert_eq!(serde_json::from_str::<Reproduction>(&text).unwrap(), found);
}
