! SPDX-License-Identifier: Apache-2.0
! A program as the Standard Tyre Interface has it in mind: Fortran that calls DTYRE and hands over
! its own ROAD, flat at height 0.01 m + 0.02 x. What it gets is compared in sti_test.cpp.

subroutine slope_road(time, dis, iflag, jflag, idtyre, idroad, nropar, ropar, nchrds, chrdst, &
                      nprsur, nroad, z, dz, ddz, dflag, prsurf, ierr)
  implicit none
  integer :: iflag, jflag, idtyre, idroad, nropar, nchrds, nprsur, nroad, dflag, ierr
  double precision :: time, dis(2), ropar(nropar), z, dz(2), ddz(3), prsurf(nprsur)
  character(len=*) :: chrdst
  ierr = 0
  if (chrdst(1:nchrds) /= 'slope' .or. idroad /= 5 .or. ropar(1) /= 0.02d0) ierr = 2
  nroad = 2
  z = 0.01d0 + ropar(1) * dis(1)
  dz = (/ ropar(1), 0.0d0 /)
  ddz = 0.0d0
  dflag = 2
  prsurf = 0.0d0
end subroutine

! Rolls `steps` of `step` s at `speed` with the wheel center at `height`; forces and torques of all.
subroutine roll_in_fortran(idtyre, nfile, file, height, speed, spin, step, steps, answers, ierr) &
    bind(c, name='roll_in_fortran')
  use iso_c_binding
  implicit none
  integer(c_int) :: idtyre, nfile, steps, ierr
  character(kind=c_char) :: file(nfile)
  real(c_double) :: height, speed, spin, step, answers(6, steps + 1)
  character(len=256) :: tire_file, road_file, model
  integer :: ndeqvr, ntypar, nvars, nwork, niwork, i, jobs(2), job
  double precision :: time, dis(3), tramat(3, 3), angle, vel(3), omega(3), typarr(64), varinf(64), &
                      empty(1), ropar(1)
  integer :: no_integers(1)
  external :: dtyre, slope_road

  tire_file = ' '
  do i = 1, nfile
    tire_file(i:i) = file(i)
  end do
  road_file = 'slope'
  ropar = 0.02d0
  tramat = 0.0d0
  do i = 1, 3
    tramat(i, i) = 1.0d0
  end do
  vel = (/ speed, 0.0d0, 0.0d0 /)
  omega = 0.0d0
  jobs = (/ 1, 2 /)
  do i = -1, steps
    job = 0
    if (i < 0) cycle
    if (i == 0) then
      time = 0.0d0
      dis = (/ 0.0d0, 0.0d0, height /)
      angle = 0.0d0
      call one(jobs(1))
      if (ierr == 0) call one(jobs(2))
      if (ierr /= 0) return
    end if
    time = i * step
    dis = (/ speed * time, 0.0d0, height /)
    angle = spin * time
    call one(job)
    if (ierr /= 0) return
  end do
  call one(99)

contains
  subroutine one(jobflg)
    integer, intent(in) :: jobflg
    integer :: place
    place = max(i, 0) + 1
    call dtyre(6, 0, jobflg, idtyre, time, dis, tramat, angle, vel, omega, spin, ndeqvr, empty, &
               ntypar, typarr, 256, tire_file, slope_road, 5, 1, ropar, 5, road_file, &
               answers(1, min(place, steps + 1)), answers(4, min(place, steps + 1)), empty, empty, &
               model, nvars, varinf, nwork, empty, niwork, no_integers, ierr)
  end subroutine
end subroutine
