//! Numbers of bytes for people: memory in powers of 1024, disks in powers of 1000 as they are labelled.

/// A number of bytes in memory: `1.2 MiB`.
pub fn human_bytes(bytes: u64) -> String {
    in_units(bytes, 1024.0, ["KiB", "MiB", "GiB", "TiB", "PiB", "EiB"])
}

/// A number of bytes on a disk: `1.2 MB`.
pub fn decimal_bytes(bytes: u64) -> String {
    in_units(bytes, 1000.0, ["kB", "MB", "GB", "TB", "PB", "EB"])
}

/// In the largest of these units, each so many times the one before, that leaves a number of 1 or more.
fn in_units(bytes: u64, times: f64, units: [&str; 6]) -> String {
    let mut value = bytes as f64;
    let mut unit = None;
    for name in units {
        if value < times {
            break;
        }
        value /= times;
        unit = Some(name);
    }
    match unit {
        None => format!("{bytes} bytes"),
        Some(unit) => format!("{value:.1} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_begin_at_their_powers() {
        let all = [0, 999, 1000, 1023, 1024, 1 << 20, u64::MAX];
        let human = all.map(human_bytes);
        assert_eq!(human[..4], ["0 bytes", "999 bytes", "1000 bytes", "1023 bytes"]);
        assert_eq!(human[4..], ["1.0 KiB", "1.0 MiB", "16.0 EiB"]);
        assert_eq!(decimal_bytes(999), "999 bytes");
        assert_eq!([1000, 1_500_000, u64::MAX].map(decimal_bytes), ["1.0 kB", "1.5 MB", "18.4 EB"]);
    }
}
