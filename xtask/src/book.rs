//! `cargo xtask book`: the documents as a book (mdBook), none of whose links is dead.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail, ensure};

/// Builds the documents as a book with mdBook, which must be installed, and checks its links.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Folder of the pages; it is emptied first.
    out: PathBuf,
}

/// Everything that a page refers to: it is copied beside the book.
const STAGED: [&str; 10] = [
    "ffi/include",
    "*.md",
    "docs",
    "machines",
    "examples",
    "python/examples",
    "benches",
    "deny.toml",
    "tests/fuzz",
    "tool/*/tests/cross_check/*",
];

/// Pages behind those of `docs/SUMMARY.md`.
const BEHIND: &str = "
# Changing jred

- [Design](DESIGN.md)
- [Contributing](CONTRIBUTING.md)
- [Changes](CHANGELOG.md)
- [Template of a firmware](examples/template/README.md)
";

pub(crate) fn run(options: &Options) -> Result<()> {
    let stage = options.out.with_extension("stage");
    for folder in [&stage, &options.out] {
        if folder.exists() {
            fs::remove_dir_all(folder)?;
        }
        fs::create_dir_all(folder)?;
    }
    copy(&stage)?;
    let out = options.out.canonicalize()?;
    let status = Command::new("mdbook")
        .arg("build")
        .arg(&stage)
        .arg("--dest-dir")
        .arg(&out)
        .status()
        .context("mdbook does not run: scripts/test book installs it")?;
    ensure!(status.success(), "mdbook failed");
    fs::remove_dir_all(&stage)?;
    let mut pages = Vec::new();
    html(&out, &mut pages)?;
    let mut dead = Vec::new();
    let mut count = 0;
    for page in &pages {
        let text = fs::read_to_string(page)?;
        for link in links(&text) {
            count += 1;
            if !leads(page, link)? {
                dead.push(format!("{}: {link}", page.display()));
            }
        }
    }
    if !dead.is_empty() {
        bail!("dead links:\n{}", dead.join("\n"));
    }
    println!("{} pages, {count} links, none of them dead", pages.len());
    Ok(())
}

/// Copies what is in Git, with links as mdBook wants them.
fn copy(stage: &Path) -> Result<()> {
    let listed = Command::new("git")
        .args(["ls-files", "-z", "--"])
        .args(STAGED)
        .output()?;
    for name in String::from_utf8(listed.stdout)?.split_terminator('\0') {
        let name = Path::new(name);
        // A file that is deleted in the work tree, or moved.
        if !name.is_file() {
            continue;
        }
        let to = match name.strip_prefix("docs") {
            Ok(own)
                if own == Path::new("SUMMARY.md")
                    || own.starts_with("book.toml")
                    || own.starts_with("book.css") =>
            {
                stage.join(own)
            }
            _ => stage.join(name),
        };
        fs::create_dir_all(to.parent().unwrap_or(stage))?;
        if to.ends_with("SUMMARY.md") {
            fs::write(to, summary(&fs::read_to_string(name)?))?;
        } else if name.extension().is_some_and(|end| end == "md") {
            fs::write(to, page(&fs::read_to_string(name)?))?;
        } else {
            fs::copy(name, to)?;
        }
    }
    Ok(())
}

/// The table of contents from the root of the repository.
fn summary(text: &str) -> String {
    let text = text.replace("](", "](docs/");
    text.replacen("# Summary", "[jred](README.md)", 1) + BEHIND
}

/// A page: mdBook writes `README.md` as `index.html`, and leaves links to it alone.
fn page(text: &str) -> String {
    let parts = text.split("](").enumerate();
    let parts = parts.map(|(k, part)| match part.split_once(')') {
        Some((link, rest)) if k > 0 => format!("{})", link.replace("README.md", "index.md")) + rest,
        _ => part.to_owned(),
    });
    parts.collect::<Vec<_>>().join("](")
}

fn html(folder: &Path, pages: &mut Vec<PathBuf>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            html(&path, pages)?;
        } else if path.extension().is_some_and(|end| end == "html") {
            pages.push(path);
        }
    }
    Ok(())
}

/// The links of a page to other files and anchors, without those to other sites.
fn links(text: &str) -> BTreeSet<&str> {
    let links = text.split("href=\"").skip(1);
    let links = links.filter_map(|rest| rest.split('"').next());
    links
        .filter(|link| !link.contains(':') && !link.is_empty() && *link != "#")
        .collect()
}

/// Whether a link of a page leads to a file, and to an anchor of it.
fn leads(page: &Path, link: &str) -> Result<bool> {
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let target = match file {
        "" => page.to_owned(),
        file => page.parent().unwrap_or(page).join(file),
    };
    if !target.exists() {
        return Ok(false);
    }
    if anchor.is_empty() || target.extension().is_none_or(|end| end != "html") {
        return Ok(true);
    }
    let text = fs::read_to_string(&target)?;
    Ok(text.contains(&format!("id=\"{anchor}\"")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_to_readme_are_links_to_the_index() {
        let found = page("see [a](docs/README.md#b), README.md and [c](d.md) (README.md)");
        assert_eq!(
            found,
            "see [a](docs/index.md#b), README.md and [c](d.md) (README.md)"
        );
    }

    #[test]
    fn the_summary_begins_at_the_root() {
        let found = summary("# Summary\n\n- [Tutorial](tutorial.md)\n");
        assert!(found.starts_with("[jred](README.md)\n\n- [Tutorial](docs/tutorial.md)\n"));
    }

    #[test]
    fn a_dead_link_is_found() {
        let folder = std::env::temp_dir().join(format!("jred-book-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let page = folder.join("a.html");
        let text = "<a href=\"a.html#here\">x</a><h1 id=\"here\"><a href=\"https://x\"><a href=\"b.html\"><a href=\"#gone\">";
        fs::write(&page, text).unwrap();
        let dead = links(text)
            .into_iter()
            .filter(|link| !leads(&page, link).unwrap());
        assert_eq!(dead.collect::<Vec<_>>(), ["#gone", "b.html"]);
        fs::remove_dir_all(&folder).unwrap();
    }
}
