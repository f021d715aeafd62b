//! Real data sets read as their publishers say. They need no device, but this is the harness that can skip a test.

use depthleap::read;
use depthleap::scene::volume::Voxels;

use crate::harness::{Need, Test, data, test};

pub fn tests() -> Vec<Test> {
    let tests = [
        test("fuel_reads_as_published", |_| fuel_reads_as_published()).needs(Need::Data("fuel.nrrd")),
        test("spacing_of_a_scan_reads_as_published", |_| spacing_of_a_scan_reads_as_published())
            .needs(Need::Data("ct_vismale.nrrd")),
    ];
    tests.into_iter().map(|test| test.within("data")).collect()
}

fn fuel_reads_as_published() {
    let volume = read::volume(&data("fuel.nrrd"), None).unwrap();
    let Voxels::U8(voxels) = &volume.voxels else { panic!("fuel is u8") };
    let mean = voxels.iter().map(|v| f64::from(*v)).sum::<f64>() / voxels.len() as f64;
    assert_eq!((volume.dims, volume.spacing), ([64; 3], [1.0; 3]));
    assert_eq!((voxels.iter().min(), voxels.iter().max()), (Some(&0), Some(&255)));
    assert!((mean - 1.9448).abs() < 5e-5, "{mean}");
}

fn spacing_of_a_scan_reads_as_published() {
    let volume = read::volume(&data("ct_vismale.nrrd"), None).unwrap();
    assert_eq!(volume.dims, [128, 256, 256]);
    assert!(volume.spacing.iter().zip([1.57774, 0.995861, 1.00797]).all(|(a, b)| (a - b).abs() < 1e-12));
}
