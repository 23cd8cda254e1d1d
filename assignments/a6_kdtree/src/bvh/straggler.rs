//! A ray of a stream that goes on alone.

use super::purpose::{At, Purpose};
use super::record::Record;
use super::stack::Stack;
use super::stream::Stream;
use super::walk::{Visit, walk};
use super::wide::{Bvh, WideNode};
use common::accel::Job;
use common::counters::Counters;
use common::math::Interval;
use common::simd::Simd;

/// Which ray it is.
pub struct Straggler {
    /// Its number in the stream.
    pub ray: usize,
    /// Where hits count.
    pub interval: Interval,
}

impl Straggler {
    /// Follows it through the tree below one node.
    #[expect(clippy::too_many_arguments, reason = "all of them belong to one loop")]
    #[inline(always)]
    pub fn go_on<S: Simd>(
        &self,
        simd: S,
        bvh: &Bvh,
        from: usize,
        stack: &mut Stack,
        stream: &mut Stream,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) {
        let Self { ray, interval } = *self;
        let Stream { records, rays, octant, room } = stream;
        let record = &mut records[ray];
        let (max, last, filter) = (record.limit(), record.last(), record.filter());
        let beam = record.beam(*room, *octant as u32).spread(simd, interval.min);
        // Hidden, or the compiler would spread all of it out for every ray; see `single`.
        let filter = std::hint::black_box(&filter);
        let job = Job { filter, ray: &rays[ray], interval };
        let mut search = Search { bvh, purpose, at: At { job, ray, last }, record };
        walk(simd, (bvh, from), stack, max, &beam, &mut search, c);
    }
}

/// What it does at leaves.
struct Search<'a, 'g, P> {
    bvh: &'a Bvh<'g>,
    purpose: &'a mut P,
    at: At<'a>,
    record: &'a mut Record,
}

impl<S: Simd, P: Purpose> Visit<S> for Search<'_, '_, P> {
    #[inline(always)]
    fn leaf(&mut self, simd: S, node: &WideNode, child: usize, c: &mut Counters) -> f32 {
        self.at.last = self.purpose.leaf(simd, self.bvh, node.child[child].held(), &self.at, c);
        self.record.end_at(self.at.last, self.at.job.filter.errors.margin());
        self.record.limit()
    }
}
