//! Numbers written as text, decimal and hexadecimal.

use depthleap::scene::volume::Voxels;

use crate::kit::{SMALL, bytes, nrrd, read_nrrd, refusal};

fn ascii() -> String {
    SMALL.replace("raw", "ascii")
}

#[test]
fn commas_and_any_white_space_stand_between_numbers() {
    for text in [
        "1 2 3 4",
        "1,2,3,4",
        "1, 2, 3, 4,",
        "1 ,2 ,3 ,4",
        " , 1 , 2 , , 3 ,, 4 , ",
        "\n1\r\n2\t3\x0c4\n",
        "+1 02 003 4",
    ] {
        let volume = read_nrrd(&ascii(), text.as_bytes());
        assert_eq!((bytes(&volume), volume.warnings.len()), (&[1, 2, 3, 4][..], 0), "{text:?}");
    }
}

#[test]
fn numbers_that_are_none_or_infinite_are_read() {
    let lines = ascii().replace("uchar", "float").replace("2 1 2", "2 2 2");
    let Voxels::F32(read) = read_nrrd(&lines, b"1 NaN -inf inf nan -NAN 1e-3 -.5").voxels else { panic!() };
    let written: Vec<String> = read.iter().map(f32::to_string).collect();
    assert_eq!(written, ["1", "NaN", "-inf", "inf", "NaN", "NaN", "0.001", "-0.5"]);
}

#[test]
fn text_that_is_no_number_of_the_type_is_named() {
    for (text, word, at) in [("1 2 256 4", "`256`", 2), ("-1 2 3 4", "`-1`", 0), ("1 2 3 1.5", "`1.5`", 3)] {
        let message = refusal(&nrrd(&ascii(), text.as_bytes()));
        assert!(message.contains(&format!("{word} for number {at}, which is not a number of type u8")), "{message}");
    }
    let long = [b"1 2 3 ".to_vec(), vec![b'9'; 5000]].concat();
    assert!(refusal(&nrrd(&ascii(), &long)).len() < 500);
}

#[test]
fn hexadecimal_digits_of_both_cases_make_bytes_wherever_white_space_stands() {
    let hex = SMALL.replace("raw", "hex");
    for text in ["0aFf7B00", "0a fF\n7b 00\n", "0 a F f 7 b 0 0", "\r\n0AFF\r\n7B00\r\n", "\t0aff7b0\t0"] {
        let volume = read_nrrd(&hex, text.as_bytes());
        assert_eq!((bytes(&volume), volume.warnings.len()), (&[0x0a, 0xff, 0x7b, 0][..], 0), "{text:?}");
    }
    let wide = hex.replace("uchar", "ushort").replace("2 1 2", "1 1 2");
    assert_eq!(read_nrrd(&format!("{wide}\nendian: big"), b"0102fffe").voxels, Voxels::U16(vec![0x0102, 0xfffe]));
    assert_eq!(read_nrrd(&format!("{wide}\nendian: little"), b"0102fffe").voxels, Voxels::U16(vec![0x0201, 0xfeff]));
}

#[test]
fn what_is_no_hexadecimal_digit_is_named_with_its_place() {
    let hex = SMALL.replace("raw", "hex");
    for (text, named) in [
        ("0a0b0g0d", "`g`, number 5,"),
        ("0x0a0b0c0d", "`x`, number 1,"),
        ("0a,0b", "`,`, number 2,"),
        ("\x07", "`\\x07`"),
    ] {
        let message = refusal(&nrrd(&hex, text.as_bytes()));
        assert!(message.contains(named) && message.contains("not a hexadecimal digit"), "{message}");
    }
}

#[test]
fn lines_and_bytes_in_front_of_text_are_skipped() {
    assert_eq!(bytes(&read_nrrd(&format!("{}\nline skip: 1", ascii()), b"x y z\n1 2 3 4")), [1, 2, 3, 4]);
    assert_eq!(bytes(&read_nrrd(&format!("{}\nbyte skip: 2", ascii()), b"v 1 2 3 4")), [1, 2, 3, 4]);
    let hex = SMALL.replace("raw", "hex");
    assert_eq!(bytes(&read_nrrd(&format!("{hex}\nline skip: 1\nbyte skip: 2"), b"hex\n0x01020304")), [1, 2, 3, 4]);
}
