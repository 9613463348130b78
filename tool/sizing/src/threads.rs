//! Work on all cores with the feature `threads`, on one core without it. The results are the same, in the same order.

#[cfg(feature = "threads")]
use rayon::prelude::*;

/// The results of `work` for 0, 1, … `count` − 1; each thread has its own `room`.
pub(crate) fn map_in<R, T: Send>(
    count: u32,
    room: impl Fn() -> R + Send + Sync,
    work: impl Fn(&mut R, u32) -> T + Send + Sync,
) -> Vec<T> {
    #[cfg(feature = "threads")]
    return (0..count).into_par_iter().map_init(room, work).collect();
    #[cfg(not(feature = "threads"))]
    {
        let mut room = room();
        (0..count).map(|k| work(&mut room, k)).collect()
    }
}

/// The results of `work` for each item.
pub fn map<I: Sync, T: Send>(items: &[I], work: impl Fn(&I) -> T + Send + Sync) -> Vec<T> {
    #[cfg(feature = "threads")]
    return items.par_iter().map(work).collect();
    #[cfg(not(feature = "threads"))]
    items.iter().map(work).collect()
}

/// Applies `work` to each item in place, with its index.
pub(crate) fn for_each<I: Send>(items: &mut [I], work: impl Fn(usize, &mut I) + Send + Sync) {
    #[cfg(feature = "threads")]
    items
        .par_iter_mut()
        .enumerate()
        .for_each(|(k, item)| work(k, item));
    #[cfg(not(feature = "threads"))]
    items
        .iter_mut()
        .enumerate()
        .for_each(|(k, item)| work(k, item));
}

/// Sorts by a key; the order of equal items is not kept.
pub(crate) fn sort_by_key<I: Send, K: Ord>(items: &mut [I], key: impl Fn(&I) -> K + Sync) {
    #[cfg(feature = "threads")]
    items.par_sort_unstable_by_key(key);
    #[cfg(not(feature = "threads"))]
    items.sort_unstable_by_key(key);
}

/// Folds 0, 1, … `count` − 1 in order, in parts of at least `share` that begin `empty` and are joined.
pub(crate) fn fold<T: Send>(
    count: usize,
    share: usize,
    empty: impl Fn() -> T + Send + Sync,
    work: impl Fn(T, usize) -> T + Send + Sync,
    join: impl Fn(T, T) -> T + Send + Sync,
) -> T {
    #[cfg(feature = "threads")]
    {
        let all = (0..count).into_par_iter().with_min_len(share);
        all.fold(&empty, work).reduce(&empty, join)
    }
    #[cfg(not(feature = "threads"))]
    {
        let _ = (share, join);
        (0..count).fold(empty(), work)
    }
}
