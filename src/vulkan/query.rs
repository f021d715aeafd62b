//! Query pools: samples passed, shader invocations, timestamps.

use std::ops::Range;
use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::failure::misuse;
use super::owned::Owned;
use crate::error::{Error, Result};

/// What the queries of a pool count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum QueryKind {
    /// Samples that passed all per-fragment tests; exact where the device can.
    Occlusion,
    /// Ticks; see [`Device::elapsed_ms`].
    Timestamp,
    /// Fragment shader invocations, as the driver counts them.
    Statistics,
}

pub struct QueryPool {
    pub name: String,
    pub kind: QueryKind,
    pub count: u32,
    pub(super) owned: Arc<Owned<vk::QueryPool>>,
}

impl QueryPool {
    /// # Errors
    /// No queries, or a kind the device does not have.
    pub fn new(device: &Arc<Device>, name: &str, kind: QueryKind, count: u32) -> Result<Self> {
        if count == 0 {
            return Err(misuse(name, "has no queries"));
        }
        let missing = match kind {
            QueryKind::Occlusion => None,
            QueryKind::Timestamp => {
                (device.info.timestamp_valid_bits == 0).then_some("timestamps on its graphics queue")
            }
            QueryKind::Statistics => (!device.info.pipeline_statistics).then_some("pipeline statistics"),
        };
        if let Some(missing) = missing {
            let problem = format!("{} has no {missing}", device.info.name);
            return Err(Error::device(name, problem, "leave them out or choose another device"));
        }
        let create = vk::QueryPoolCreateInfo::default().query_count(count);
        let create = match kind {
            QueryKind::Occlusion => create.query_type(vk::QueryType::OCCLUSION),
            QueryKind::Timestamp => create.query_type(vk::QueryType::TIMESTAMP),
            QueryKind::Statistics => create
                .query_type(vk::QueryType::PIPELINE_STATISTICS)
                .pipeline_statistics(vk::QueryPipelineStatisticFlags::FRAGMENT_SHADER_INVOCATIONS),
        };
        // SAFETY: the device is alive and has the feature.
        let raw = device.check("vkCreateQueryPool", name, unsafe { device.raw.create_query_pool(&create, None) })?;
        device.name(raw, name);
        // SAFETY of the destroyer: called once, when nothing uses the pool any more.
        let owned = Owned::new(device, raw, |device, raw| unsafe { device.destroy_query_pool(raw, None) });
        Ok(Self { name: name.into(), kind, count, owned })
    }

    /// The results, waiting for those that are on their way; timestamps without the bits that do not count. Read
    /// only queries that a submitted recording writes: the wait for any other never ends.
    ///
    /// # Errors
    /// A range beyond the pool, or a lost device.
    pub fn read(&self, range: Range<u32>) -> Result<Vec<u64>> {
        self.check(&range)?;
        let device = &self.owned.device;
        let mut results = vec![0_u64; range.len()];
        if results.is_empty() {
            return Ok(results);
        }
        let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
        // SAFETY: the range is inside the pool, and each query has one result of eight bytes.
        let read = unsafe { device.raw.get_query_pool_results(self.owned.raw, range.start, &mut results, flags) };
        device.check("vkGetQueryPoolResults", &self.name, read)?;
        if self.kind == QueryKind::Timestamp {
            results.iter_mut().for_each(|ticks| *ticks &= device.timestamp_mask());
        }
        Ok(results)
    }

    pub(super) fn check(&self, range: &Range<u32>) -> Result<()> {
        match range.start <= range.end && range.end <= self.count {
            true => Ok(()),
            false => Err(misuse(&self.name, format!("queries {range:?} of {}", self.count))),
        }
    }
}
