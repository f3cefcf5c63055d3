//! A cache that is passed from one build to the next. Values are found by content.

use std::{
    collections::HashMap,
    hash::{Hash, Hasher},
    sync::{Arc, Weak},
};

/// Values keyed by everything that determines them. A value stays while the newest build or the newest complete one
/// uses it, and the previous complete one until the next is done: at most two programs and one failed build are kept.
pub(super) struct Cache<K, V> {
    entries: HashMap<K, Entry<V>>,
    build: u64,
}

struct Entry<V> {
    value: V,
    /// The newest build that used it.
    used_by: u64,
    /// True if the newest complete build used it.
    used_by_complete: bool,
}

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self { entries: HashMap::new(), build: 0 }
    }
}

impl<K: Eq + Hash, V> Cache<K, V> {
    /// Returns the value of a key, and marks it as used by this build.
    pub(crate) fn get(&mut self, key: &K) -> Option<&V> {
        let entry = self.entries.get_mut(key)?;
        entry.used_by = self.build;
        Some(&entry.value)
    }

    /// Returns whether a value exists, without marking it as used.
    pub(crate) fn contains(&self, key: &K) -> bool {
        self.entries.contains_key(key)
    }

    /// Adds a value that this build uses.
    pub(crate) fn insert(&mut self, key: K, value: V) {
        self.entries.insert(key, Entry { value, used_by: self.build, used_by_complete: false });
    }

    /// Returns every value.
    pub(crate) fn values(&self) -> impl Iterator<Item = &V> {
        self.entries.values().map(|entry| &entry.value)
    }

    /// Ends a build. Drops values that neither it nor the newest complete build before it used.
    pub(crate) fn end_build(&mut self, is_whole: bool) {
        let build = self.build;
        self.entries.retain(|_, entry| entry.used_by == build || entry.used_by_complete);
        if is_whole {
            self.entries.values_mut().for_each(|entry| entry.used_by_complete = entry.used_by == build);
        }
        self.build += 1;
    }

    /// Returns the number of values.
    #[cfg(test)]
    pub(crate) fn len(&self) -> usize {
        self.entries.len()
    }
}

/// A key by address that keeps the allocation reserved while it lives, so that equal addresses mean the same value.
/// Does not keep the value itself alive.
pub(super) struct ByAddress<T>(Weak<T>);

impl<T> ByAddress<T> {
    pub(crate) fn of(value: &Arc<T>) -> Self {
        Self(Arc::downgrade(value))
    }
}

impl<T> Clone for ByAddress<T> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<T> PartialEq for ByAddress<T> {
    fn eq(&self, other: &Self) -> bool {
        self.0.ptr_eq(&other.0)
    }
}

impl<T> Eq for ByAddress<T> {}

impl<T> Hash for ByAddress<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.as_ptr().hash(state);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Builds with these keys; returns the keys of newly created values.
    fn build(cache: &mut Cache<char, ()>, keys: &str, is_whole: bool) -> String {
        let mut made = String::new();
        for key in keys.chars() {
            if cache.get(&key).is_none() {
                cache.insert(key, ());
                made.push(key);
            }
        }
        cache.end_build(is_whole);
        made
    }

    #[test]
    fn values_of_the_last_two_complete_builds_stay() {
        let mut cache = Cache::default();
        assert_eq!(build(&mut cache, "abc", true), "abc");
        assert_eq!(build(&mut cache, "abd", true), "d");
        assert_eq!(build(&mut cache, "abc", true), "", "back to the text before");
        assert_eq!(build(&mut cache, "abe", true), "e");
        assert_eq!(build(&mut cache, "abd", true), "d", "which two builds have not used");
    }

    #[test]
    fn failed_builds_keep_the_running_programs_values_and_do_not_accumulate() {
        let mut cache = Cache::default();
        build(&mut cache, "abc", true);
        for key in 'f'..='z' {
            assert_eq!(build(&mut cache, &format!("a{key}"), false), key.to_string());
            assert_eq!(cache.len(), 4, "those of the whole one and {key}");
        }
        assert_eq!(build(&mut cache, "abc", true), "");
        assert_eq!(build(&mut cache, "abc", true), "");
        assert_eq!(cache.len(), 3);
    }

    #[test]
    fn addresses_are_not_reused_while_a_key_exists() {
        let first = Arc::new([1u8; 64]);
        let key = ByAddress::of(&first);
        assert!(key == ByAddress::of(&first));
        drop(first);
        for _ in 0..100 {
            assert!(key != ByAddress::of(&Arc::new([1u8; 64])));
        }
    }
}
