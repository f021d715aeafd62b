//! What every test of a reader needs: files in folders of their own, headers, packers, and where voxels lie.

use std::io::Write;
use std::path::PathBuf;

use bzip2::write::BzEncoder;
use depthleap::Result;
use depthleap::read::{self, ByteSkip, RawLayout, ReadChoice};
use depthleap::scene::settings::{Component, Orientation};
use depthleap::scene::volume::{Volume, VoxelType, Voxels};
use flate2::write::GzEncoder;
use glam::DVec3;
use tempfile::TempDir;

/// A folder of its own with a file in it.
pub fn file(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

pub fn read_with(name: &str, bytes: &[u8], choice: &ReadChoice) -> Result<Volume> {
    let (_folder, path) = file(name, bytes);
    read::volume_with(&path, None, choice)
}

pub fn read_as(name: &str, bytes: &[u8]) -> Result<Volume> {
    read_with(name, bytes, &ReadChoice::default())
}

/// The volume in an attached file of these header lines and data.
pub fn read_nrrd(lines: &str, data: &[u8]) -> Volume {
    read_as("a.nrrd", &nrrd(lines, data)).unwrap_or_else(|e| panic!("{lines}: {e}"))
}

/// The message of the error, which must come.
pub fn refusal(bytes: &[u8]) -> String {
    read_as("a.nrrd", bytes).unwrap_err().to_string()
}

/// An attached header of these lines, then the data.
pub fn nrrd(lines: &str, data: &[u8]) -> Vec<u8> {
    [b"NRRD0005\n", lines.as_bytes(), b"\n\n", data].concat()
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

pub fn bzip2(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = BzEncoder::new(Vec::new(), bzip2::Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// A 2x1x2 volume of bytes.
pub const SMALL: &str = "type: uchar\ndimension: 3\nsizes: 2 1 2\nencoding: raw";

/// A header of bytes of these sizes, with further lines.
pub fn sized(sizes: &[usize], lines: &str) -> String {
    let words = sizes.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
    format!("type: uchar\nencoding: raw\ndimension: {}\nsizes: {words}\n{lines}", sizes.len()).trim_end().to_owned()
}

/// 0, 1, 2 ...: no two bytes of a file that has no more than 256 are alike.
pub fn counted(sizes: &[usize]) -> Vec<u8> {
    let count: usize = sizes.iter().product();
    assert!(count <= 256);
    (0..=255).take(count).collect()
}

/// The volume that is chosen of a file of such bytes.
pub fn chosen(sizes: &[usize], lines: &str, choice: &ReadChoice) -> Result<Volume> {
    read_with("a.nrrd", &nrrd(&sized(sizes, lines), &counted(sizes)), choice)
}

/// The same where nothing is chosen, and all is well.
pub fn volume(sizes: &[usize], lines: &str) -> Volume {
    chosen(sizes, lines, &ReadChoice::default()).unwrap_or_else(|e| panic!("{lines}: {e}"))
}

pub fn component(component: Component) -> ReadChoice<'static> {
    ReadChoice { component: Some(component), ..ReadChoice::default() }
}

pub fn frame(frame: usize) -> ReadChoice<'static> {
    ReadChoice { frame: Some(frame), ..ReadChoice::default() }
}

pub fn by_index() -> ReadChoice<'static> {
    ReadChoice { orientation: Orientation::Index, ..ReadChoice::default() }
}

/// Little endian bytes with nothing in front.
pub fn layout(dims: [usize; 3], voxel_type: VoxelType) -> RawLayout {
    RawLayout { dims, voxel_type, spacing: [1.0; 3], big_endian: false, skip: ByteSkip::Bytes(0) }
}

pub fn bytes(volume: &Volume) -> &[u8] {
    match &volume.voxels {
        Voxels::U8(bytes) => bytes,
        other => panic!("{:?} are no bytes", other.voxel_type()),
    }
}

/// All values as f64.
pub fn values(volume: &Volume) -> Vec<f64> {
    (0..volume.voxels.len()).map(|i| volume.voxels.get(i)).collect()
}

/// Where the voxels of a volume lie about its centre, in the axes of volume space and the file's unit, by their value.
pub fn places(volume: &Volume) -> Vec<(f64, DVec3)> {
    let [x, y, _] = volume.dims;
    let place = |i: usize| {
        let index = [i % x, i / x % y, i / (x * y)];
        let centred = |a: usize| (index[a] as f64 - 0.5 * (volume.dims[a] as f64 - 1.0)) * volume.spacing[a];
        volume.turn * DVec3::from_array([0, 1, 2].map(centred))
    };
    let mut places: Vec<_> = (0..volume.voxels.len()).map(|i| (volume.voxels.get(i), place(i))).collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    places
}

/// Whether one of the sentences holds all of these parts.
pub fn says(sentences: &[String], parts: &[&str]) -> bool {
    sentences.iter().any(|sentence| parts.iter().all(|part| sentence.contains(part)))
}
