//! Misuse while recording, queries, timestamps.

use std::sync::Arc;

use depthleap::vulkan::{Commands, Device, Place, QueryKind, QueryPool};

use super::kit::{FILL, buffer, misuse, refused, run};
use crate::harness::{Need, Test, test, tests};

pub fn all() -> Vec<Test> {
    let mut all = tests![
        dispatch_beyond_the_limits_is_refused,
        query_outside_the_pool_is_refused,
        pool_without_queries_is_refused,
        first_misuse_is_the_one_reported,
        kinds_the_device_lacks_are_refused,
        timestamps_never_fall,
        elapsed_time_survives_a_wrap,
        steps_are_marked_without_complaint,
    ];
    all.push(
        test("recording_for_another_family_is_refused", recording_for_another_family_is_refused)
            .needs(Need::ComputeFamily),
    );
    all
}

fn dispatch_beyond_the_limits_is_refused(device: &Arc<Device>) {
    // The limits themselves are smaller on every device: 2^32 - 1 work groups in y or z are allowed nowhere.
    for groups in [[1, u32::MAX, 1], [1, 1, u32::MAX]] {
        let text = format!("{groups:?} work groups");
        refused(misuse(device, |commands| commands.dispatch(groups)), &["misuse", &text, "are allowed"]);
    }
}

fn query_outside_the_pool_is_refused(device: &Arc<Device>) {
    let pool = QueryPool::new(device, "three", QueryKind::Occlusion, 3).unwrap();
    refused(misuse(device, |commands| commands.begin_query(&pool, 3)), &["three", "queries 3..4 of 3"]);
    refused(misuse(device, |commands| commands.end_query(&pool, 7)), &["three", "queries 7..8 of 3"]);
    refused(misuse(device, |commands| commands.reset_queries(&pool, 1..4)), &["three", "queries 1..4 of 3"]);
    refused(misuse(device, |commands| commands.begin_query(&pool, u32::MAX)), &["three", "of 3"]);
    refused(pool.read(2..4), &["three", "queries 2..4 of 3"]);
    assert!(pool.read(3..3).unwrap().is_empty());
}

fn pool_without_queries_is_refused(device: &Arc<Device>) {
    refused(QueryPool::new(device, "none", QueryKind::Occlusion, 0), &["none", "has no queries"]);
}

fn first_misuse_is_the_one_reported(device: &Arc<Device>) {
    let numbers = buffer(device, "numbers", 4, Place::Device);
    let recorded = misuse(device, |commands| {
        commands.fill_buffer(&numbers, 0, 8, 0);
        commands.dispatch([1, 1, u32::MAX]);
    });
    refused(recorded, &["numbers", "8 bytes at 0 of 4"]);
}

fn kinds_the_device_lacks_are_refused(device: &Arc<Device>) {
    let lacks = [
        (QueryKind::Statistics, !device.info.pipeline_statistics, "pipeline statistics"),
        (QueryKind::Timestamp, device.info.timestamp_valid_bits == 0, "timestamps"),
    ];
    for (kind, lacking, words) in lacks {
        let pool = QueryPool::new(device, "wanted", kind, 1);
        match lacking {
            true => refused(pool, &["wanted", &device.info.name, words]),
            false => assert_eq!(pool.unwrap().kind, kind),
        }
    }
}

fn timestamps_never_fall(device: &Arc<Device>) {
    const COUNT: u32 = 9;
    let pool = match QueryPool::new(device, "times", QueryKind::Timestamp, COUNT) {
        Ok(pool) => pool,
        Err(error) => return eprintln!("not run: {error}"),
    };
    // 64 MiB take their time everywhere.
    let numbers = buffer(device, "numbers", 64 << 20, Place::Device);
    let begin = std::time::Instant::now();
    run(device, "times", |commands| {
        commands.reset_queries(&pool, 0..COUNT);
        for i in 0..COUNT {
            commands.timestamp(&pool, i);
            commands.fill_buffer(&numbers, 0, 64 << 20, i);
            commands.buffer_barrier(&numbers, FILL, FILL);
        }
    });
    let wall = begin.elapsed().as_secs_f64() * 1e3;
    let ticks = pool.read(0..COUNT).unwrap();
    let steps: Vec<f64> = ticks.windows(2).map(|pair| device.elapsed_ms(pair[0], pair[1])).collect();
    // A step backwards would be the length of the whole counter.
    assert!(steps.iter().all(|&ms| ms <= wall), "{steps:?} of {wall} ms");
    assert!(steps.iter().sum::<f64>() > 0.0, "{ticks:?}");
}

/// What the difference of two timestamps is, a tick at a time, over the end of the counter.
fn elapsed_time_survives_a_wrap(device: &Arc<Device>) {
    let bits = [&device.graphics, &device.compute].map(|queue| queue.timestamp_valid_bits);
    let Some(bits) = bits.into_iter().filter(|&bits| bits > 0).min() else {
        return eprintln!("not run: {} has no timestamps", device.info.name);
    };
    let last = u64::MAX >> (64 - bits);
    let tick = f64::from(device.info.timestamp_period) * 1e-6;
    for (start, end, ticks) in [(3, 10, 7.0), (5, 5, 0.0), (last, 0, 1.0), (last - 9, 5, 15.0)] {
        // Products of small whole numbers with one factor: within a rounding of each.
        assert!((device.elapsed_ms(start, end) - ticks * tick).abs() <= 1e-15 * ticks, "{start} to {end}");
    }
    assert_eq!(device.ticks_to_ms(1_000_000), 1e6 * f64::from(device.info.timestamp_period) * 1e-6);
}

fn steps_are_marked_without_complaint(device: &Arc<Device>) {
    device.set_step_names(["first".to_owned(), "second".to_owned()].into());
    run(device, "steps", |commands| {
        commands.step(0);
        commands.step(1);
        // A step that has no name is no mistake.
        commands.step(2);
    });
}

fn recording_for_another_family_is_refused(device: &Arc<Device>) {
    let commands = Commands::begin(device, &device.compute, "for compute").unwrap();
    let recorded = commands.finish().unwrap();
    let text = format!("was recorded for queue family {}", device.compute.family);
    refused(device.graphics.submit(&recorded, &[]), &["for compute", &text]);
}
