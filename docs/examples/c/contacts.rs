// Spheres against a plane, many at once, in Rust.   rustc contacts.rs $(pkg-config --libs-only-L contact-oracle-c)
use std::ptr::null_mut;

#[repr(C)]
pub struct Sphere {
    pub center: [f64; 3],
    pub radius: f64,
}
#[repr(C)]
pub struct Plane {
    pub normal: [f64; 3],
    pub offset: f64,
}
#[repr(C)]
pub struct Contacts {
    pub state: *mut u8, // null where it is not wanted, and so on
    pub normal: *mut [f64; 3],
    pub point1: *mut [f64; 3],
    pub point2: *mut [f64; 3],
    pub value: *mut f64,
}

#[link(name = "contact-oracle")]
extern "C" {
    fn contact_compute_sphere_plane(
        count: usize, a: *const Sphere, b: *const Plane, alarm: f64, contact: f64, points: i32, out: *const Contacts, hits: *mut usize,
    ) -> i32;
}

fn main() {
    let sphere = |x, z| Sphere { center: [x, 0.0, z], radius: 1.0 };
    let floor = || Plane { normal: [0.0, 0.0, 1.0], offset: 0.0 };
    let (spheres, floors) = ([sphere(0.0, 0.5), sphere(1.0, 1.0), sphere(2.0, 3.0)], [floor(), floor(), floor()]);
    let (mut state, mut value, mut hits) = ([0u8; 3], [0.0; 3], 0);
    let out = Contacts {
        state: state.as_mut_ptr(),
        normal: null_mut(),
        point1: null_mut(),
        point2: null_mut(),
        value: value.as_mut_ptr(),
    };
    // Safe: every array has as many rows as the count says.
    let status = unsafe { contact_compute_sphere_plane(3, spheres.as_ptr(), floors.as_ptr(), 0.0, 0.0, 0, &out, &mut hits) };
    assert_eq!(status, 0);
    println!("{hits} hits");
    for i in (0..3).filter(|&i| state[i] != 0) {
        println!("sphere {i}: value {:4.1}", value[i]);
    }
}
