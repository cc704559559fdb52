# What `cmake --install` puts where, and the Debian package of it: the program with its man pages and completions, which it
# writes itself, udev rules, units of systemd, and the firmware images that are built. The emulator stays out, because it is
# for tests.
include_guard(GLOBAL)
include(GNUInstallDirs)
set(files ${CMAKE_CURRENT_LIST_DIR}/package)

install(TARGETS astrolabe)
install(FILES ${files}/60-astrolabe.rules DESTINATION lib/udev/rules.d)
install(FILES ${files}/astrolabe-ros2@.service ${files}/astrolabe-serve@.service DESTINATION lib/systemd/system)
install(FILES ${files}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${CMAKE_SOURCE_DIR}/build/teensy40/bin/astrolabe-teensy40.hex DESTINATION share/astrolabe/firmware
  OPTIONAL)
install(CODE "set(program $<TARGET_FILE:astrolabe>)\nset(changelog ${files}/changelog)")
install(CODE [[
  set(share "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share")
  function(made_by_program file)
    file(MAKE_DIRECTORY ${share}/${file}/..)
    execute_process(COMMAND ${program} completion ${ARGN} OUTPUT_FILE ${share}/${file} COMMAND_ERROR_IS_FATAL ANY)
  endfunction()
  made_by_program(bash-completion/completions/astrolabe bash)
  made_by_program(zsh/vendor-completions/_astrolabe zsh)
  made_by_program(fish/vendor_completions.d/astrolabe.fish fish)
  file(REMOVE_RECURSE ${share}/man)
  execute_process(COMMAND ${program} manual ${share}/man/man1 COMMAND_ERROR_IS_FATAL ANY)
  file(COPY ${changelog} DESTINATION ${share}/doc/astrolabe)
  file(GLOB texts ${share}/man/man1/*.1)
  # Without names and times, so that two builds give the same bytes.
  execute_process(COMMAND gzip -9nf ${texts} ${share}/doc/astrolabe/changelog COMMAND_ERROR_IS_FATAL ANY)
]])

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME astrolabe)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "The Astrolabe authors <astrolabe@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "calibrates the odometry of differential-drive robots")
set(CPACK_PACKAGE_DESCRIPTION "Firmware and tools for robots with two driven wheels. Ground truth from a tracker,
a phone film, a wall or a tape measure gives the factors of both wheels and the
wheelbase with their errors; they are loaded into the robot, and drives before and
after show what they are worth. 'astrolabe demo' does all of it with a simulated
robot.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, teensy-loader-cli")  # films; flashing
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_SOURCE_DIR}/build/package)
include(CPack)
