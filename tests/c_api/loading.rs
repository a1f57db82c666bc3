//! Reading models: both ways, every fault, every size of message buffer.

use std::ffi::{CString, c_char};
use std::ptr::{dangling_mut, null, null_mut};

use nearwall::c_api::*;

use crate::calls::Calls;
use crate::common::random::EVERY_REGIME;

/// Room for a message, poisoned so that a stray write shows.
struct Room([u8; 400]);

impl Room {
    fn new() -> Self {
        Self([0xA5; 400])
    }

    fn start(&mut self) -> *mut c_char {
        self.0.as_mut_ptr().cast()
    }

    /// What was written up to its closing zero; the rest has to be untouched.
    fn text(&self) -> &str {
        let end = self.0.iter().position(|byte| *byte == 0).expect("a closing zero");
        assert!(self.0[end + 1..].iter().all(|byte| *byte == 0xA5), "written beyond the closing zero");
        std::str::from_utf8(&self.0[..end]).expect("whole characters")
    }
}

/// Loads a file that cannot be loaded: status and message; the handle is untouched.
fn load_fault(calls: &Calls, path: &str) -> (i32, String) {
    fault(|model, message, size| {
        let path = CString::new(path).unwrap();
        unsafe { (calls.nw_model_load)(path.as_ptr(), model, message, size) }
    })
}

/// The same for a text.
fn parse_fault(calls: &Calls, toml: &[u8], name: Option<&str>) -> (i32, String) {
    let name = name.map(|name| CString::new(name).unwrap());
    fault(|model, message, size| {
        let name = name.as_ref().map_or(null(), |name| name.as_ptr());
        unsafe { (calls.nw_model_parse)(toml.as_ptr().cast(), toml.len(), name, model, message, size) }
    })
}

fn fault(call: impl Fn(*mut *mut nw_model, *mut c_char, usize) -> i32) -> (i32, String) {
    let poison: *mut nw_model = dangling_mut();
    let mut model = poison;
    let mut room = Room::new();
    let status = call(&raw mut model, room.start(), room.0.len());
    assert_eq!((model, call(&raw mut model, null_mut(), 7)), (poison, status), "without room for a message");
    assert_ne!(status, NW_OK);
    (status, room.text().to_owned())
}

#[test]
fn file_and_text_give_the_same_model() {
    let calls = Calls::load();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ash wäll.toml");
    std::fs::write(&path, EVERY_REGIME).unwrap();
    let path = CString::new(path.to_str().unwrap()).unwrap();
    let (mut model, mut room) = (null_mut(), Room::new());
    let status = unsafe { (calls.nw_model_load)(path.as_ptr(), &raw mut model, room.start(), room.0.len()) };
    assert_eq!((status, room.0), (NW_OK, [0xA5; 400]), "nothing to say on success");
    let parsed = calls.parse(EVERY_REGIME);
    let impact = nw_impact { v_n: 3.0, wall: 1, T_p: 1700.0, T_w: 1700.0, ..nw_impact::default() };
    let outcomes = [model, parsed].map(|model| crate::calls::bytes(&calls.resolve(model, &impact).unwrap()));
    assert_eq!(outcomes[0], outcomes[1]);
    unsafe {
        calls.free(model);
        (calls.nw_model_free)(parsed);
        (calls.nw_model_free)(null_mut());
    }
}

#[test]
fn the_text_ends_where_its_size_says() {
    let calls = Calls::load();
    let text = format!("{EVERY_REGIME}this is no longer TOML");
    let model = calls.parse(&text[..EVERY_REGIME.len()]);
    calls.free(model);
}

#[test]
fn files_that_cannot_be_read() {
    let calls = Calls::load();
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().to_str().unwrap();
    for path in ["", "/nowhere/nearWall.toml", folder, "/nowhere/näh.toml"] {
        let (status, message) = load_fault(&calls, path);
        assert_eq!(status, NW_FILE);
        assert!(message.starts_with(&format!("{path}: cannot be read: ")), "{message}");
    }
    let broken = format!("{folder}/broken.toml");
    std::fs::write(&broken, [b'x', 0xFF, 0xFE]).unwrap();
    assert_eq!(load_fault(&calls, &broken).0, NW_FILE);
    std::fs::write(&broken, &EVERY_REGIME[..EVERY_REGIME.len() / 2]).unwrap();
    assert_eq!(load_fault(&calls, &broken).0, NW_MODEL, "a file that was cut off");
}

#[test]
fn texts_that_are_no_model() {
    let calls = Calls::load();
    let name = Some("m.toml");
    let (status, message) = parse_fault(&calls, b"x = = 1", name);
    assert_eq!(status, NW_MODEL);
    assert!(message.starts_with("m.toml:1:5: not valid TOML"), "{message}");
    assert!(parse_fault(&calls, b"x = = 1", None).1.starts_with("model:1:5: "));
    let wrong = EVERY_REGIME.replace("fly-ash", "fly-ach");
    let (status, message) = parse_fault(&calls, wrong.as_bytes(), name);
    assert_eq!(status, NW_MODEL);
    assert!(message.contains("did you mean `fly-ash`?"), "{message}");

    let stiff = format!("{EVERY_REGIME}[materials.p]\ndensity = 1\nyoungs_modulus = 70e90\n");
    let (status, message) = parse_fault(&calls, stiff.as_bytes(), name);
    assert_eq!(status, NW_MODEL);
    assert!(
        message.contains("materials.p.youngs_modulus: 7e91 is outside the allowed range 1 to 1e13"),
        "{message}"
    );

    assert_eq!(
        parse_fault(&calls, b"x = \"\xC3\"", name),
        (NW_NOT_UTF8, "a string is not valid UTF-8".to_owned())
    );
    assert_eq!(parse_fault(&calls, b"x = 1\0y = 2", name).0, NW_MODEL);
    assert_eq!(parse_fault(&calls, &[0; 100], name).0, NW_MODEL);
    assert_eq!(parse_fault(&calls, b"", name).0, NW_MODEL);
    let (_, message) = parse_fault(&calls, b"\"a\\u0000b\" = 1\n[particle]\nmaterial = \"wax\\u0000\"", name);
    assert!(message.contains('\u{2400}'), "the zero shows and does not end the text: {message}");
}

#[test]
fn texts_that_try_to_exhaust() {
    let calls = Calls::load();
    let deep = format!("x = {}", "[".repeat(100_000));
    assert_eq!(parse_fault(&calls, deep.as_bytes(), None).0, NW_MODEL);
    let deep = format!("x = {}1{}", "{a=".repeat(100_000), "}".repeat(100_000));
    assert_eq!(parse_fault(&calls, deep.as_bytes(), None).0, NW_MODEL);
    let deep = format!("[{}]", "a.".repeat(50_000) + "a");
    assert_eq!(parse_fault(&calls, deep.as_bytes(), None).0, NW_MODEL);
    for pattern in
        ["(".repeat(5000) + "a" + &")".repeat(5000), "((((a{9999}){9999}){9999}){9999})".to_owned()]
    {
        let wall = EVERY_REGIME.replace("quench.*", &pattern);
        let (status, message) = parse_fault(&calls, wall.as_bytes(), None);
        assert_eq!(status, NW_MODEL);
        assert!(message.starts_with("model:"), "{message}");
    }
}

#[test]
fn null_pointers_and_impossible_sizes() {
    let calls = Calls::load();
    let refused = |status: i32, call: &dyn Fn(*mut *mut nw_model, *mut c_char, usize) -> i32| {
        let (found, message) = fault(call);
        let text = calls.text(unsafe { (calls.nw_status_text)(status) });
        assert_eq!((found, message.as_str()), (status, text));
    };
    let toml = EVERY_REGIME.as_ptr().cast::<c_char>();
    let size = EVERY_REGIME.len();
    unsafe {
        refused(NW_NULL_POINTER, &|model, text, room| (calls.nw_model_load)(null(), model, text, room));
        refused(NW_NULL_POINTER, &|_, text, room| {
            (calls.nw_model_load)(c"x".as_ptr(), null_mut(), text, room)
        });
        refused(NW_NOT_UTF8, &|model, text, room| {
            (calls.nw_model_load)(c"/tmp/\xFF".as_ptr(), model, text, room)
        });
        refused(NW_NULL_POINTER, &|model, text, room| {
            (calls.nw_model_parse)(null(), 5, null(), model, text, room)
        });
        refused(NW_NULL_POINTER, &|_, text, room| {
            (calls.nw_model_parse)(toml, size, null(), null_mut(), text, room)
        });
        refused(NW_STRUCT_SIZE, &|model, text, room| {
            (calls.nw_model_parse)(toml, usize::MAX, null(), model, text, room)
        });
    }
}

#[test]
fn a_name_that_is_not_utf8_is_shown_as_well_as_it_can_be() {
    let calls = Calls::load();
    let (status, message) = fault(|model, text, room| unsafe {
        (calls.nw_model_parse)(c"x".as_ptr(), 1, c"m\xFF.toml".as_ptr(), model, text, room)
    });
    assert_eq!(status, NW_MODEL);
    assert!(message.starts_with("m\u{FFFD}.toml:1:"), "{message}");
}

#[test]
fn messages_fit_any_buffer() {
    let calls = Calls::load();
    let name = "äöü€𝄞.toml";
    let (_, whole) = parse_fault(&calls, b"x = = 1", Some(name));
    assert!(whole.starts_with(name));
    let name = CString::new(name).unwrap();
    let mut cut = 0;
    for size in 0..whole.len() + 3 {
        let (mut model, mut room) = (null_mut(), Room::new());
        let text = c"x = = 1".as_ptr();
        let status =
            unsafe { (calls.nw_model_parse)(text, 7, name.as_ptr(), &raw mut model, room.start(), size) };
        assert!(status == NW_MODEL && model.is_null());
        if size == 0 {
            assert_eq!(room.0, [0xA5; 400]);
            continue;
        }
        let text = room.text();
        assert!(whole.starts_with(text) && text.len() < size, "{size}: {text}");
        assert!(text.len() + 4 >= size.min(whole.len()), "no more is cut than a character: {size}: {text}");
        cut += u32::from(text.len() + 1 < size.min(whole.len() + 1));
    }
    assert_eq!(cut, 3 + 2 + 3, "sizes that end inside a character");
}

#[test]
fn statuses_and_regimes_have_words() {
    let calls = Calls::load();
    let text = |status| calls.text(unsafe { (calls.nw_status_text)(status) });
    let texts: std::collections::HashSet<&str> = (NW_OK..=NW_NO_HEAT_CAPACITY).map(text).collect();
    assert_eq!(texts.len(), 13);
    for status in [-1, 13, i32::MIN, i32::MAX] {
        assert_eq!(text(status), "unknown status");
    }
    let name = |regime| calls.text(unsafe { (calls.nw_regime_name)(regime) });
    for regime in nearwall::Regime::ALL {
        assert_eq!(name(regime as u32), regime.name());
    }
    assert_eq!((name(4), name(u32::MAX)), ("unknown regime", "unknown regime"));
    assert_eq!(calls.text(unsafe { (calls.nw_version)() }), env!("CARGO_PKG_VERSION"));
    assert_eq!(unsafe { (calls.nw_abi_version)() }, NW_ABI_VERSION);
}

#[test]
fn walls_are_found() {
    let calls = Calls::load();
    let model = calls.parse(EVERY_REGIME);
    let find = |model: *const nw_model, name: *const c_char| {
        let mut wall = 0xA5A5_A5A5_u32;
        let status = unsafe { (calls.nw_model_find_wall)(model, name, &raw mut wall) };
        assert!((status == NW_OK) != (wall == 0xA5A5_A5A5), "written on success only");
        if status == NW_OK { Ok(wall) } else { Err(status) }
    };
    let names = [c"default", c"slag", c"quench.*", c"quenchRing", c"Slag", c"", c"slag\xFF"];
    let found = names.map(|name| find(model, name.as_ptr()));
    let (unknown, not_utf8) = (Err(NW_UNKNOWN_WALL), Err(NW_NOT_UTF8));
    assert_eq!(found, [Ok(0), Ok(1), Ok(2), Ok(2), unknown, unknown, not_utf8]);
    assert_eq!(find(null(), c"slag".as_ptr()), Err(NW_NULL_POINTER));
    assert_eq!(find(model, null()), Err(NW_NULL_POINTER));
    let status = unsafe { (calls.nw_model_find_wall)(model, c"slag".as_ptr(), null_mut()) };
    assert_eq!(status, NW_NULL_POINTER);
    calls.free(model);
}
