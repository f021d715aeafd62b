//! Headers that lie, contradict themselves or say what nobody knows: refused by name, before memory is taken for them.

use crate::kit::{SMALL, gzip, nrrd, read_as, refusal, sized};

#[test]
fn a_wrong_beginning_is_refused_with_what_stands_there() {
    assert!(refusal(b"NRRD0009\ntype: uchar\n\n").contains("NRRD0009"));
    assert!(refusal(b"P5 12 12").contains("P5 12 12"));
    let unknown = read_as("a.xyz", b"hello").unwrap_err().to_string();
    assert!(unknown.contains("no known volume format (5 bytes)") && unknown.contains(".nrrd"), "{unknown}");
    let packed = read_as("a.xyz", &gzip(b"hello")).unwrap_err().to_string();
    assert!(packed.contains("no known volume format"), "{packed}");
}

#[test]
fn huge_sizes_are_refused_before_anything_is_allocated() {
    for sizes in
        ["4294967295 4294967295 4294967295", "1048576 1048576 1048576", "99999 99999 9", "99999999999999999999 1 1"]
    {
        for encoding in ["raw", "gzip", "bzip2", "ascii", "hex"] {
            let lines = format!("type: double\nendian: little\ndimension: 3\nsizes: {sizes}\nencoding: {encoding}");
            let data = match encoding {
                "ascii" | "hex" => b"1 2 3".to_vec(),
                "bzip2" => crate::kit::bzip2(&[0; 64]),
                _ => gzip(&[0; 64]),
            };
            let message = refusal(&nrrd(&lines, &data));
            assert!(["overflow", "ask for", "not a number"].iter().any(|m| message.contains(m)), "{message}");
        }
    }
}

#[test]
fn lying_headers_are_refused_by_name() {
    for (from, to, named) in [
        ("sizes: 2 1 2", "sizes: 2 1", "sizes"),
        ("sizes: 2 1 2", "sizes: 2 1 2 1", "sizes"),
        ("sizes: 2 1 2", "sizes: 0 1 2", "at least 1"),
        ("sizes: 2 1 2", "sizes: -2 1 2", "`-2`"),
        ("sizes: 2 1 2", "content: none", "sizes: is missing"),
        ("dimension: 3", "dimension: 2", "2 sizes"),
        ("dimension: 3", "dimension: 0", "dimension: is 0"),
        ("dimension: 3", "dimension: 17", "dimension: is 17"),
        ("dimension: 3", "dimension: 3.5", "dimension: has `3.5`"),
        ("dimension: 3", "content: none", "dimension: is missing"),
        ("dimension: 3\nsizes: 2 1 2", "dimension: 1\nsizes: 4", "1 axes, of which 1 may lie in space"),
        ("uchar", "char", "`char`"),
        ("uchar", "block", "`block`"),
        ("type: uchar", "content: none", "type: is missing"),
        ("uchar", "ushort", "endian: is missing"),
        ("uchar", "ushort\nendian: middle", "`middle`"),
        ("encoding: raw", "content: none", "encoding: is missing"),
        ("raw", "gzi", "`gzi`, which is unknown; convert it to one of raw, gzip, bzip2, ascii, hex"),
        ("raw", "raw\nspacing: 1 1 1", "did you mean `spacings`"),
        ("raw", "raw\ntype: uchar", "given twice"),
        ("raw", "raw\nwhat is this", "not a line of an NRRD header"),
        ("raw", "raw\ndata file: absent.raw", "absent.raw"),
        ("raw", "raw\ndata file: .", "not a regular file"),
        ("raw", "raw\ndata file: ", "data file: is empty"),
        ("raw", "raw\nspacings: 1 0 1", "axis 1 is 0"),
        ("raw", "raw\nspacings: 1 inf 1", "axis 1 is inf"),
        ("raw", "raw\nspacings: 1 1", "2 entries"),
        ("raw", "raw\nspacings: 1 one 1", "`one`"),
        ("raw", "raw\nspacings: 1e-300 1 1", "sides"),
        ("raw", "raw\nkinds: domain domain", "kinds: has 2 entries where there are 3 axes"),
        ("raw", "raw\ncenters: cell cell corner", "centers: has `corner`"),
        ("raw", "raw\naxis mins: 0 0", "axis mins: has 2 entries"),
        ("raw", "raw\nspace directions: (1,0,0) (0,1,0) (0,0,0)", "axis 2 is 0"),
        ("raw", "raw\nspace directions: (1,0,0) (0,1,0) (0,0,inf)", "axis 2 is inf"),
        ("raw", "raw\nspace directions: (1,0,0) (0,1", "space directions"),
        ("raw", "raw\nspace directions: (1,0,0) (0,1,0)", "space directions: has 2 entries"),
        ("raw", "raw\nspace directions: (1,0,0) (0,x,0) (0,0,1)", "space directions: has `x`"),
        ("raw", "raw\nbyte skip: 5", "has 4 bytes of the 5 to be skipped"),
        ("raw", "raw\nbyte skip: -2", "`-2`"),
        ("raw", "raw\nline skip: 9999999999999", "line skip"),
        ("raw", "raw\nline skip: -1", "line skip: has `-1`"),
        ("raw", "gzip\nbyte skip: -1", "encoding: raw"),
        ("raw", "hex\nbyte skip: -1", "encoding: raw"),
        ("raw", "ascii", "numbers"),
    ] {
        let message = refusal(&nrrd(&SMALL.replace(from, to), &[0; 4]));
        assert!(message.contains(named), "{to}: {message}");
        // A data file is named itself.
        assert!(message.contains("a.nrrd") || to.contains("data file"), "{to}: {message}");
    }
}

/// Fields that give the spacing of one axis twice, and differently.
#[test]
fn contradicting_spacings_are_refused_by_name() {
    for (lines, named) in [
        (
            "spacings: 1 1 1\nspace directions: (1,0,0) (0,2,0) (0,0,1)",
            "along axis 1 is 2 by `space directions`, but 1 by `spacings`",
        ),
        (
            "spacings: 1 1 1\naxis mins: 0 0 0\naxis maxs: 4 5 7\ncenters: cell cell cell",
            "along axis 2 is 1 by `spacings`, but 1.16",
        ),
        (
            "axis mins: 0 nan nan\naxis maxs: 4 nan nan\ncenters: node node node\n\
             space directions: (1,0,0) (0,1,0) (0,0,1)",
            "along axis 0 is 1 by `space directions`, but 1.3333333333333333 by `axis mins` and `axis maxs`",
        ),
    ] {
        let message = refusal(&nrrd(&sized(&[4, 5, 6], lines), &[0; 120]));
        assert!(message.contains(named) && message.contains("remove the field that is wrong"), "{message}");
    }
}

#[test]
fn a_header_without_end_is_refused() {
    let endless = [b"NRRD0001\n".to_vec(), vec![b'#'; 3 << 20]].concat();
    assert!(refusal(&endless).contains("type: is missing"));
    let unended = format!("NRRD0001\n{SMALL}\n");
    assert!(refusal(unended.as_bytes()).contains("not ended by an empty line"));
}
