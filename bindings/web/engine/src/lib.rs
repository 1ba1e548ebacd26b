//! The engine of the page: one function that takes a request and gives an answer, as bytes.
//!
//! A message in either direction is a header of JSON and blocks of numbers behind it ([`message`]). No tool
//! writes glue for it: JavaScript asks [`reserve`] for room, writes its request there, calls [`answer`] and
//! reads. Everything physical is a call of the library; what stands here are requests, one per file.

pub mod colours;
pub mod drop;
pub mod message;
pub mod photograph;
pub mod ray_paths;
pub mod scattered;
pub mod scene_text;
pub mod sky;

use message::{Reply, Request, Trouble};
use std::sync::Mutex;

/// What a request is answered with, whichever side of the border calls.
pub fn respond(bytes: &[u8]) -> Vec<u8> {
    let answer = Request::read(bytes).and_then(|request| dispatch(&request));
    match answer {
        Ok(reply) => reply.write(),
        Err(trouble) => trouble.reply().write(),
    }
}

fn dispatch(request: &Request) -> Result<Reply, Trouble> {
    match request.op.as_str() {
        "about" => scene_text::about(),
        "scene" => scene_text::scene(request),
        "rays" => ray_paths::rays(request),
        "scattered" => scattered::scattered(request),
        "column" => colours::column(request),
        "paint" => colours::paint(request),
        "sky" => sky::sky(request),
        "photograph" => photograph::overlay(request),
        "cut" => photograph::cut(request),
        "misfit" => photograph::misfit(request),
        other => Err(Trouble::new("op", format!("\"{other}\" is not known"))),
    }
}

/// What a panic said last: where the engine breaks off there is nobody else to tell.
static LAST_WORDS: Mutex<String> = Mutex::new(String::new());

/// Have panics remembered for [`last_words`].
#[unsafe(no_mangle)]
pub extern "C" fn listen() {
    std::panic::set_hook(Box::new(|panic| {
        if let Ok(mut words) = LAST_WORDS.lock() {
            *words = panic.to_string();
        }
    }));
}

/// What the last panic said, as [`answer`] gives answers.
#[unsafe(no_mangle)]
pub extern "C" fn last_words() -> *mut u8 {
    handed_over(LAST_WORDS.lock().map(|words| words.clone()).unwrap_or_default().as_bytes())
}

/// Bytes behind their own length, in room that [`release`] takes back.
fn handed_over(bytes: &[u8]) -> *mut u8 {
    let whole = 8 + bytes.len();
    let place = reserve(whole);
    // SAFETY: `reserve` gave room for at least `whole` bytes.
    let out = unsafe { std::slice::from_raw_parts_mut(place, whole) };
    out[..8].copy_from_slice(&(bytes.len() as u64).to_le_bytes());
    out[8..].copy_from_slice(bytes);
    place
}

/// Room for a request of so many bytes; it is given back by [`answer`].
#[unsafe(no_mangle)]
pub extern "C" fn reserve(length: usize) -> *mut u8 {
    // as f64, so that blocks of numbers are aligned on both sides
    let room: Box<[f64]> = vec![0.0; length.div_ceil(8)].into_boxed_slice();
    Box::into_raw(room).cast()
}

/// Answer the request of `length` bytes in the room that [`reserve`] gave for as many. What comes back starts
/// with its own length as a little-endian u64; [`release`] takes it back.
///
/// # Safety
/// `room` comes from [`reserve`] with the same length, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn answer(room: *mut u8, length: usize) -> *mut u8 {
    let words = length.div_ceil(8);
    // SAFETY: by the contract this is the box that `reserve` leaked.
    let request =
        unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(room.cast::<f64>(), words)) };
    // SAFETY: f64s are readable as bytes, and `length` is at most eight times their number.
    let bytes = unsafe { std::slice::from_raw_parts(request.as_ptr().cast::<u8>(), length) };
    handed_over(&respond(bytes))
}

/// Take back an answer.
///
/// # Safety
/// `place` comes from [`answer`] and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn release(place: *mut u8) {
    // SAFETY: the first eight bytes of an answer are its length.
    let length = unsafe { place.cast::<u64>().read() } as usize + 8;
    // SAFETY: the box that `reserve` leaked for it.
    drop(unsafe {
        Box::from_raw(std::ptr::slice_from_raw_parts_mut(place.cast::<f64>(), length.div_ceil(8)))
    });
}
