//! Is that HTML whole, and does it need nothing else? For tests.

/// Elements that have no end.
const VOID: [&str; 5] = ["meta", "br", "hr", "img", "input"];

/// Makes sure that every tag is closed in its order, and that nothing is fetched from elsewhere.
///
/// # Panics
/// If not.
pub fn assert_self_contained(page: &str) {
    if let Err(what) = balance(page) {
        panic!("{what}");
    }
    for word in ["http", "src=", "url(", "@import", "<link", "<script"] {
        assert!(!page.contains(word), "the page has `{word}`");
    }
}

fn balance(page: &str) -> Result<(), String> {
    let (mut open, mut rest) = (Vec::new(), page);
    while let Some(start) = rest.find('<') {
        let tag = &rest[start + 1..];
        let end = tag.find('>').ok_or_else(|| format!("`<{:.20}` is not closed", tag))?;
        let (inside, after) = (&tag[..end], &tag[end + 1..]);
        rest = after;
        if inside.contains('<') {
            return Err(format!("`<{inside}>` is no tag"));
        }
        let name = inside.trim_start_matches('/').split([' ', '\n', '/']).next().unwrap_or_default();
        if inside.starts_with('!') || inside.ends_with('/') || VOID.contains(&name) {
            continue;
        }
        if !inside.starts_with('/') {
            open.push(name);
        } else if open.pop() != Some(name) {
            return Err(format!("</{name}> closes nothing; open are {open:?}"));
        }
    }
    if open.is_empty() { Ok(()) } else { Err(format!("{open:?} are not closed")) }
}

#[test]
fn what_is_not_whole_is_found() {
    assert_eq!(balance("<!DOCTYPE html><a b=\"c\"><br><d/>1 &lt; 2</a>"), Ok(()));
    for bad in ["<a><b></a></b>", "<a>", "</a>", "<a", "<a <b>></a>"] {
        assert!(balance(bad).is_err(), "{bad}");
    }
}
