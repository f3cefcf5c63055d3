//! A cache that one build leaves for the next. Values are found by content.

use std::{
    collections::HashMap,
    hash::{Hash, Hasher},
    sync::{Arc, Weak},
};

/// Values by all that they are made of. A value stays as long as the newest build or the newest whole one uses it, and
/// the whole one before that until the next is done: what is kept is bounded by two programs and one that failed.
pub(super) struct Cache<K, V> {
    entries: HashMap<K, Entry<V>>,
    build: u64,
}

struct Entry<V> {
    value: V,
    /// The newest build that used it.
    used_by: u64,
    /// The newest whole build used it.
    is_of_whole: bool,
}

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self { entries: HashMap::new(), build: 0 }
    }
}

impl<K: Eq + Hash, V> Cache<K, V> {
    /// Returns the value of a key, which this build uses from now on.
    pub(crate) fn get(&mut self, key: &K) -> Option<&V> {
        let entry = self.entries.get_mut(key)?;
        entry.used_by = self.build;
        Some(&entry.value)
    }

    /// Returns whether a value is there, which nothing uses by that.
    pub(crate) fn holds(&self, key: &K) -> bool {
        self.entries.contains_key(key)
    }

    /// Adds a value that this build uses.
    pub(crate) fn insert(&mut self, key: K, value: V) {
        self.entries.insert(key, Entry { value, used_by: self.build, is_of_whole: false });
    }

    /// Returns every value that is there.
    pub(crate) fn values(&self) -> impl Iterator<Item = &V> {
        self.entries.values().map(|entry| &entry.value)
    }

    /// Ends a build. Forgets what neither it nor the newest whole build before it used.
    pub(crate) fn end_build(&mut self, is_whole: bool) {
        let build = self.build;
        self.entries.retain(|_, entry| entry.used_by == build || entry.is_of_whole);
        if is_whole {
            self.entries.values_mut().for_each(|entry| entry.is_of_whole = entry.used_by == build);
        }
        self.build += 1;
    }

    /// Returns the number of values.
    #[cfg(test)]
    pub(crate) fn len(&self) -> usize {
        self.entries.len()
    }
}

/// A value by its place in memory, which stays taken as long as this lives: equal places hold the same value. Does not
/// keep the value itself.
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

    /// Builds with these keys; returns those that had to be made.
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
    fn what_the_last_two_whole_builds_used_stays() {
        let mut cache = Cache::default();
        assert_eq!(build(&mut cache, "abc", true), "abc");
        assert_eq!(build(&mut cache, "abd", true), "d");
        assert_eq!(build(&mut cache, "abc", true), "", "back to the text before");
        assert_eq!(build(&mut cache, "abe", true), "e");
        assert_eq!(build(&mut cache, "abd", true), "d", "which two builds have not used");
    }

    #[test]
    fn builds_that_fail_take_nothing_from_the_program_that_runs_and_do_not_pile_up() {
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
    fn an_address_is_not_taken_again_while_a_key_has_it() {
        let first = Arc::new([1u8; 64]);
        let key = ByAddress::of(&first);
        assert!(key == ByAddress::of(&first));
        drop(first);
        for _ in 0..100 {
            assert!(key != ByAddress::of(&Arc::new([1u8; 64])));
        }
    }
}
