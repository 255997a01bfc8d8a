//! Sources that are damaged or mean harm: each ends in an error that names the entry, and the store keeps what it had.

use crate::sources::{assert_sound, gzip, header, import, scratch, tar_of, write_folder, xz, zip_of};
use robohive_store::{ImportOptions, Limits, Store, StoreError};
use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use tar::EntryType;
use zip::write::SimpleFileOptions;

const GOOD: (&str, &str) = ("envs/arms/good.xml", "<mujoco/>");

/// A store with one file, and a folder beside it for sources.
fn filled(name: &str) -> (Store, PathBuf) {
    let folder = scratch(name);
    write_folder(&folder.join("source"), &[GOOD]);
    let mut store = Store::open(folder.join("store")).unwrap();
    import(&mut store, &folder.join("source")).unwrap();
    (store, folder)
}

/// Imports bytes as an archive and returns the message of the error; nothing may have changed.
fn refusal(store: &mut Store, folder: &Path, bytes: &[u8], limits: Limits) -> String {
    let path = folder.join("hostile");
    fs::write(&path, bytes).unwrap();
    let options = ImportOptions::default().with_limits(limits).with_replace(true);
    let error = store.import(&path, &options, &mut |_| ()).expect_err("the source is accepted");
    assert_eq!(store.entries().len(), 1);
    assert_sound(store);
    error.to_string()
}

fn assert_refused(store: &mut Store, folder: &Path, bytes: &[u8], parts: &[&str]) {
    let message = refusal(store, folder, bytes, Limits::default());
    assert!(parts.iter().all(|part| message.contains(part)), "{message:?} lacks one of {parts:?}");
}

/// A tar archive with a good file and an entry whose name the `tar` crate would not write.
fn tar_with(mut header: tar::Header, name: &[u8], content: &[u8]) -> Vec<u8> {
    header.as_mut_bytes()[..name.len()].copy_from_slice(name);
    header.set_cksum();
    let mut bytes = tar_of(&[("envs/arms/first.xml", "1")]);
    bytes.truncate(1024);
    bytes.extend_from_slice(header.as_bytes());
    bytes.extend_from_slice(content);
    bytes.resize(bytes.len().next_multiple_of(512) + 1024, 0);
    bytes
}

fn file_named(name: &[u8]) -> Vec<u8> {
    tar_with(header(EntryType::Regular, 1), name, b"x")
}

#[test]
fn paths_out_of_the_archive_are_refused() {
    let (mut store, folder) = filled("paths");
    let cases: [(&[u8], &[&str]); 6] = [
        (b"envs/arms/../../../evil.xml", &["entry \"envs/arms/../../../evil.xml\"", "`..`"]),
        (b"/etc/evil.xml", &["entry \"/etc/evil.xml\"", "absolute"]),
        (b"../evil.xml", &["entry \"../evil.xml\"", "`..`"]),
        (b"envs/arms/\xff.xml", &["not UTF-8"]),
        (b"envs/arms/..\\evil.xml", &["holds '\\\\'"]),
        (b"C:/evil.xml", &["entry \"C:/evil.xml\"", "holds ':'"]),
    ];
    for (name, parts) in cases {
        assert_refused(&mut store, &folder, &file_named(name), parts);
        let Ok(name) = std::str::from_utf8(name) else { continue };
        let files = [GOOD, (name, "x")];
        assert_refused(&mut store, &folder, &zip_of(&files), parts);
        assert_refused(&mut store, &folder, &gzip(&file_named(name.as_bytes())), parts);
    }
    assert!(!folder.join("evil.xml").exists() && !folder.parent().unwrap().join("evil.xml").exists());
}

/// Long names come in headers of their own, which are held to the same rules.
#[test]
fn long_names_are_held_to_the_same_rules() {
    let (mut store, folder) = filled("long");
    let long = format!("{}../../evil.xml", "a/".repeat(100));
    let gnu = tar_with(header(EntryType::GNULongName, long.len()), b"././@LongLink", long.as_bytes());
    let named = [&gnu[..gnu.len() - 1024], &file_named(b"short.xml")[1024..]].concat();
    assert_refused(&mut store, &folder, &named, &["evil.xml\"", "`..`"]);

    let record = format!("{} path=/evil.xml\n", "18 path=/evil.xml\n".len());
    let pax = tar_with(header(EntryType::XHeader, record.len()), b"pax", record.as_bytes());
    let named = [&pax[..pax.len() - 1024], &file_named(b"short.xml")[1024..]].concat();
    assert_refused(&mut store, &folder, &named, &["entry \"/evil.xml\"", "absolute"]);

    let mut link = header(EntryType::Symlink, 0);
    link.set_link_name("short").unwrap();
    let target = tar_with(header(EntryType::GNULongLink, long.len()), b"././@LongLink", long.as_bytes());
    let linked = [&target[..target.len() - 1024], &tar_with(link, b"link.xml", b"")[1024..]].concat();
    assert_refused(&mut store, &folder, &linked, &["entry \"link.xml\"", "a symbolic link"]);

    let sparse = "22 GNU.sparse.major=1\n";
    let pax = tar_with(header(EntryType::XHeader, sparse.len()), b"pax", sparse.as_bytes());
    assert_refused(&mut store, &folder, &pax, &["entry \"pax\"", "a sparse file"]);

    for damaged in ["99 path=a\n", "x path=a\n", "12 path=abcd", "7 path\n", "9 size=x\n", "\n"] {
        let pax = tar_with(header(EntryType::XHeader, damaged.len()), b"pax", damaged.as_bytes());
        assert_refused(&mut store, &folder, &pax, &["entry \"pax\"", "extended header is damaged"]);
    }
    let huge = tar_with(header(EntryType::GNULongName, 1 << 30), b"huge", b"");
    assert_refused(&mut store, &folder, &huge, &["entry \"huge\"", "more than 65536 bytes"]);
}

#[test]
fn links_and_devices_are_refused() {
    let (mut store, folder) = filled("links");
    let kinds = [
        (EntryType::Symlink, "a symbolic link"),
        (EntryType::Link, "a hard link"),
        (EntryType::Char, "a device"),
        (EntryType::Block, "a device"),
        (EntryType::Fifo, "a pipe"),
        (EntryType::GNUSparse, "a sparse file"),
        (EntryType::new(b'M'), "several volumes"),
        (EntryType::new(b'?'), "unknown kind '?'"),
    ];
    for (kind, what) in kinds {
        let mut header = header(kind, 0);
        header.set_link_name("/etc/passwd").unwrap();
        let archive = tar_with(header, b"envs/arms/link.xml", b"");
        assert_refused(&mut store, &folder, &archive, &["entry \"envs/arms/link.xml\"", what]);
    }
    for (mode, what) in [(0o120_777, "a symbolic link"), (0o020_644, "a device or pipe")] {
        let mut bytes = zip_of(&[GOOD, ("envs/arms/link.xml", "/etc/passwd")]);
        // The mode of the second entry, in the upper half of its external attributes in the central directory.
        let at = bytes.windows(4).rposition(|w| w == b"PK\x01\x02").unwrap();
        bytes[at + 5] = 3;
        bytes[at + 40..at + 42].copy_from_slice(&u16::try_from(mode).unwrap().to_le_bytes());
        assert_refused(&mut store, &folder, &bytes, &["entry \"envs/arms/link.xml\"", what]);
    }
}

#[test]
fn archives_that_unpack_to_too_much_are_refused() {
    let (mut store, folder) = filled("bombs");
    let zeros = "\0".repeat(24 << 20);
    let tar = tar_of(&[GOOD, ("envs/arms/bomb.stl", &zeros)]);
    let ratio = ["entry \"envs/arms/bomb.stl\"", "ratio=250", "--limit ratio=NUMBER"];
    for bomb in [gzip(&tar), xz(&tar)] {
        assert_refused(&mut store, &folder, &bomb, &ratio);
    }
    let mut writer = zip::ZipWriter::new(Cursor::new(Vec::new()));
    writer.start_file("envs/arms/bomb.stl", SimpleFileOptions::default()).unwrap();
    writer.write_all(zeros.as_bytes()).unwrap();
    assert_refused(&mut store, &folder, &writer.finish().unwrap().into_inner(), &ratio);
    // A bomb that is skipped is unpacked all the same.
    let skipped = xz(&tar_of(&[GOOD, ("notes.txt", &zeros)]));
    assert_refused(&mut store, &folder, &skipped, &["entry \"notes.txt\"", "ratio=250"]);

    let refused = |store: &mut Store, limits| {
        refusal(store, &folder, &tar_of(&[GOOD, ("envs/arms/b.xml", &"x".repeat(4000))]), limits)
    };
    let small = Limits::default().with_bytes(3000);
    assert!(refused(&mut store, small).contains("entry \"envs/arms/b.xml\": more than the limit bytes=3000"));
    let few = Limits::default().with_files(1);
    assert!(refused(&mut store, few).contains("entry \"envs/arms/b.xml\": more than the limit files=1"));
    let short = Limits::default().with_path(16);
    assert!(refused(&mut store, short).contains("entry \"envs/arms/good.xml\": more than the limit path=16"));
    let flat = Limits::default().with_depth(2);
    assert!(refused(&mut store, flat).contains("entry \"envs/arms/good.xml\": more than the limit depth=2"));

    // What was refused is accepted once the limit is raised.
    fs::write(folder.join("large.tar.xz"), xz(&tar)).unwrap();
    let options =
        ImportOptions::default().with_limits(Limits::default().with_ratio(1 << 20)).with_replace(false);
    assert_eq!(store.import(&folder.join("large.tar.xz"), &options, &mut |_| ()).unwrap().added, 1);
}

/// A header of an xz stream may ask for a dictionary of 4 GiB; memory is bounded.
#[test]
fn a_decoder_cannot_ask_for_all_memory() {
    let (mut store, folder) = filled("memory");
    let mut bytes = xz(&tar_of(&[GOOD]));
    // Block header after the stream header of 12 bytes: size, flags, filter, its size, dictionary; then a checksum.
    let end = 12 + (usize::from(bytes[12]) + 1) * 4;
    assert_eq!(bytes[14..16], [0x21, 1]);
    bytes[16] = 40;
    let sum = crc32(&bytes[12..end - 4]);
    bytes[end - 4..end].copy_from_slice(&sum.to_le_bytes());
    assert_refused(&mut store, &folder, &bytes, &["the xz data is damaged", "memory"]);
}

fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = flate2::Crc::new();
    crc.update(bytes);
    crc.sum()
}

/// Cut anywhere, an archive is refused: what is missing might be files.
#[test]
fn truncated_archives_are_refused() {
    let (mut store, folder) = filled("truncated");
    let body: String = (0..2000).map(|i| format!("{}\n", i * 7919 % 1000)).collect();
    let tar = tar_of(&[("envs/arms/good.xml", "<mujoco/>"), ("envs/arms/b.xml", &body)]);
    let archives = [tar.clone(), xz(&tar), gzip(&tar), zip_of(&[GOOD, ("envs/arms/b.xml", &body)])];
    for (kind, archive) in archives.iter().enumerate() {
        // The end mark of a plain archive is long, and its first block is enough.
        let whole = if kind == 0 { archive.len() - 1024 } else { archive.len() };
        for cut in (0..whole).step_by(whole / 40).chain([whole - 1]) {
            refusal(&mut store, &folder, &archive[..cut], Limits::default());
        }
    }
    let cut = &tar[..tar.len() / 2];
    assert_refused(&mut store, &folder, cut, &["entry \"envs/arms/b.xml\"", "truncated"]);
}

/// A changed byte of a compressed archive is found by its checksums.
#[test]
fn damaged_archives_are_refused() {
    let (mut store, folder) = filled("damaged");
    let body: String = (0..2000).map(|i| format!("{}\n", i * 7919 % 1000)).collect();
    let files = [("envs/arms/b.xml", body.as_str())];
    for archive in [xz(&tar_of(&files)), gzip(&tar_of(&files)), zip_of(&files)] {
        // Beyond the headers, in which a time or a flag may change without consequence.
        for at in (64..archive.len() / 2).step_by(archive.len() / 20) {
            let mut changed = archive.clone();
            changed[at] ^= 0x10;
            refusal(&mut store, &folder, &changed, Limits::default());
        }
    }
    let mut tar = tar_of(&[GOOD]);
    tar[100] ^= 1;
    assert_refused(&mut store, &folder, &tar, &["neither a folder nor a tar"]);
    let appended = [tar_of(&[GOOD]), tar_of(&[GOOD])].concat();
    assert_refused(&mut store, &folder, &appended, &["data follows the end of the archive"]);
}

/// Bytes changed at random, with checksums of headers made to fit so that what they guard is reached too: every archive
/// ends in an error or in an import, and either way in a sound store with nothing written beside it.
#[test]
fn archives_changed_at_random_do_no_harm() {
    let folder = scratch("random");
    let long = format!("simhive/{}/b.obj", "long".repeat(30));
    let files = [GOOD, ("simhive/Adroit/a.stl", "solid"), (long.as_str(), "v 0 0 0"), ("setup.py", "")];
    let (tar, zip) = (tar_of(&files), zip_of(&files));
    let mut word = 1_u32;
    let mut draw = |n: usize| {
        word = word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (word >> 8) as usize % n
    };
    let limits = Limits::default().with_bytes(1 << 20);
    let (mut imported, mut refused) = (0, 0);
    for round in 0..240 {
        let mut bytes = if round % 3 == 2 { zip.clone() } else { tar.clone() };
        for _ in 0..=draw(3) {
            let at = draw(bytes.len());
            bytes[at] = [0, b'.', b'/', b'7', 0xff, b'1', draw(256) as u8][draw(7)];
        }
        if round % 3 != 2 {
            fit_checksums(&mut bytes);
        }
        if round % 3 == 1 {
            bytes = if round % 2 == 0 { xz(&bytes) } else { gzip(&bytes) };
            let at = draw(4 * bytes.len());
            bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << draw(8));
        }
        fs::write(folder.join("changed"), bytes).unwrap();
        _ = fs::remove_dir_all(folder.join("store"));
        let mut store = Store::open(folder.join("store")).unwrap();
        let options = ImportOptions::default().with_limits(limits).with_replace(false);
        match store.import(&folder.join("changed"), &options, &mut |_| ()) {
            Ok(_) => imported += 1,
            Err(error) => refused += i32::from(!error.to_string().is_empty()),
        }
        assert_sound(&Store::open(folder.join("store")).unwrap());
        let beside: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(beside.len(), 2, "round {round}: {beside:?}");
    }
    assert!(imported > 20 && refused > 20, "{imported} imported, {refused} refused");
}

/// Gives every block that looks like a header of a tar archive the checksum of its bytes.
fn fit_checksums(bytes: &mut [u8]) {
    for block in bytes.chunks_exact_mut(512).filter(|block| &block[257..262] == b"ustar") {
        block[148..156].fill(b' ');
        let sum: u32 = block.iter().map(|&byte| u32::from(byte)).sum();
        block[148..156].copy_from_slice(format!("{sum:06o}\0 ").as_bytes());
    }
}

#[test]
fn other_files_are_refused_for_what_they_are() {
    let (mut store, folder) = filled("others");
    for bytes in [&b""[..], b"<html>not found</html>", b"\x7fELF", &[0; 4096]] {
        assert_refused(&mut store, &folder, bytes, &["hostile: neither a folder nor a tar"]);
    }
    assert_refused(&mut store, &folder, &gzip(b"<mujoco/>"), &["truncated"]);
    assert_refused(&mut store, &folder, &xz(&[b'x'; 2048]), &["no tar archive"]);
    assert_refused(&mut store, &folder, b"PK\x03\x04 and no more", &["damaged or truncated zip"]);
    let foreign = tar_of(&[("models/arm.xml", "<mujoco/>"), ("envs/arm.xml", "<mujoco/>")]);
    assert_refused(&mut store, &folder, &foreign, &["none of its 2 model files", "wheel"]);
    let twice = tar_of(&[("envs/arms/a.xml", "1"), ("envs/arms/a.xml", "2")]);
    assert_refused(
        &mut store,
        &folder,
        &twice,
        &["envs/arms/a.xml: envs/arms/a.xml and envs/arms/a.xml differ"],
    );
    let missing = import(&mut store, &folder.join("nothing")).unwrap_err();
    assert!(matches!(missing, StoreError::Io { .. }) && missing.to_string().contains("nothing"), "{missing}");
}

/// Links inside of a folder are followed; those that lead out, in circles or to nothing are named and skipped.
#[test]
#[cfg(unix)]
fn links_in_folders_stay_inside() {
    use std::os::unix::fs::symlink;
    let folder = scratch("folder links");
    let source = folder.join("source");
    write_folder(&source, &[GOOD, ("envs/arms/real.stl", "solid")]);
    write_folder(&folder, &[("secret.xml", "secret")]);
    symlink(folder.join("secret.xml"), source.join("envs/arms/out.xml")).unwrap();
    symlink("..", source.join("envs/arms/circle")).unwrap();
    symlink("nowhere", source.join("envs/arms/broken.xml")).unwrap();
    symlink("real.stl", source.join("envs/arms/inside.stl")).unwrap();
    let mut store = Store::open(folder.join("store")).unwrap();
    let imported = import(&mut store, &source).unwrap();
    let paths = crate::sources::paths(&store);
    assert_eq!(paths, ["envs/arms/good.xml", "envs/arms/inside.stl", "envs/arms/real.stl"]);
    let links = ["envs/arms/broken.xml", "envs/arms/circle", "envs/arms/out.xml"];
    assert_eq!(imported.skipped.links, links);
    assert!(fs::symlink_metadata(store.resolve("envs/arms/inside.stl").unwrap()).unwrap().is_file());
}
