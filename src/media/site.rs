//! Shadertoy's own textures, cubemaps and volumes, by id, each with the built-in texture that is Eddy's fallback.
//!
//! Sizes and channels are facts about Shadertoy; its pictures themselves are not included. A fallback has the same size
//! and channels and a similar kind of content, so that a shader looks as intended if not identical.

/// A file of Shadertoy.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SiteFile {
    pub id: &'static str,
    /// The first characters of the file's name, which is a hash; for JSON without ids.
    pub hash: &'static str,
    /// The name of the built-in texture.
    pub fallback: &'static str,
    /// Uploaded as one channel.
    pub is_grey: bool,
}

const fn rgba(id: &'static str, hash: &'static str, fallback: &'static str) -> SiteFile {
    SiteFile { id, hash, fallback, is_grey: false }
}

const fn grey(id: &'static str, hash: &'static str, fallback: &'static str) -> SiteFile {
    SiteFile { id, hash, fallback, is_grey: true }
}

/// Its 22 textures, six cubemaps and two volumes, each kind ordered by how often it is used.
pub(crate) const SITE_FILES: [SiteFile; 30] = [
    rgba("4dXGzr", "08b42b43ae9d", "font"),
    rgba("4dfGRn", "8de3a3924cb9", "street"),
    rgba("Xsf3zn", "f735bee5b64e", "noise-rgba-256"),
    rgba("XdX3Rn", "52d2a8f514c4", "marble"),
    grey("4dXGzn", "0c7bf5fe9462", "noise-grey-256"),
    rgba("4dXGRn", "10eb4fe0ac8a", "brick"),
    rgba("XsBSR3", "cb49c003b454", "blue-noise"),
    grey("4sf3Rr", "ad56fba948df", "pebbles"),
    rgba("XsX3Rn", "92d7758c402f", "granite"),
    rgba("4sXGRn", "95b90082f799", "rust"),
    rgba("XsfGRn", "1f7dca9c22f3", "wood"),
    rgba("4sfGRn", "fb918796edc3", "lichen"),
    grey("4sf3Rn", "0a40562379b6", "noise-grey-64"),
    rgba("XdXGzn", "3083c722c0c7", "noise-rgba-64"),
    rgba("XdfGRn", "e6e5631ce123", "stars"),
    rgba("Xsf3Rr", "79520a3d3a0f", "grass"),
    rgba("4dX3Rn", "bd6464771e47", "fabric"),
    rgba("4df3Rr", "3871e838723d", "moss"),
    grey("Xdf3zn", "85a6d68622b3", "bayer-8"),
    rgba("Xsf3Rn", "cbcbb5a6cfb5", "sprites"),
    rgba("XsXGRn", "cd4c518bc6ef", "coral"),
    rgba("XdXGzr", "8979352a182b", "dunes"),
    rgba("XsfGzn", "585f9546c092", "gallery"),
    rgba("XdX3zn", "488bd40303a2", "hall"),
    rgba("XsX3zn", "94284d43be78", "forest"),
    rgba("4sX3zn", "0681c014f6c8", "forest-blurred"),
    rgba("4sfGzn", "793a105653fb", "gallery-blurred"),
    rgba("4dX3zn", "550a8cce1bf4", "hall-blurred"),
    grey("4sfGRr", "27012b4eadd0", "noise-grey-3d"),
    rgba("XdX3Rr", "aea6b99da1d5", "noise-rgba-3d"),
];

/// Returns the file with an id, or with a path that ends in its name.
pub(crate) fn site_file(id: &str, path: &str) -> Option<&'static SiteFile> {
    let name = path.rsplit('/').next().unwrap_or_default();
    SITE_FILES.iter().find(|s| s.id == id).or_else(|| SITE_FILES.iter().find(|s| name.starts_with(s.hash)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_found_by_id_or_path() {
        assert_eq!(site_file("XsfGRn", "").unwrap().fallback, "wood");
        assert_eq!(site_file("", "/media/a/1f7dca9c22f324751f2a.jpg").unwrap().fallback, "wood");
        assert!(site_file("", "/media/a/").is_none() && site_file("", "").is_none());
    }
}
