! Spheres against a plane, many at once, in Fortran.   gfortran contacts.f90 $(pkg-config --libs contact-oracle-c)
module contact_oracle
  use, intrinsic :: iso_c_binding
  implicit none

  type, bind(c) :: contact_contacts  ! pointers; c_null_ptr where nothing is wanted
    type(c_ptr) :: state = c_null_ptr, normal = c_null_ptr, point1 = c_null_ptr, point2 = c_null_ptr, value = c_null_ptr
  end type

  interface
    ! Spheres are columns of a(4, count): centre and radius.
    integer(c_int32_t) function contact_compute_sphere_plane(count, a, b, alarm, contact, points, out, hits) bind(c)
      import
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: a(4, *), b(4, *)
      real(c_double), value :: alarm, contact
      integer(c_int32_t), value :: points
      type(contact_contacts), intent(in) :: out
      integer(c_size_t), intent(out) :: hits
    end function
  end interface
end module

program contacts
  use contact_oracle
  implicit none
  real(c_double) :: spheres(4, 3) = reshape([real(c_double) :: 0, 0, 0.5, 1, 1, 0, 1, 1, 2, 0, 3, 1], [4, 3])
  real(c_double) :: floors(4, 3) = reshape([real(c_double) :: 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0], [4, 3])
  integer(c_int8_t), target :: state(3)
  real(c_double), target :: values(3)
  type(contact_contacts) :: out
  integer(c_size_t) :: hits
  integer :: i

  out%state = c_loc(state)
  out%value = c_loc(values)
  if (contact_compute_sphere_plane(3_c_size_t, spheres, floors, 0d0, 0d0, 0_c_int32_t, out, hits) /= 0) error stop
  print '(i0, a)', hits, " hits"
  do i = 1, 3
    if (state(i) /= 0) print '(a, i0, a, f4.1)', "sphere ", i - 1, ": value ", values(i)
  end do
end program
