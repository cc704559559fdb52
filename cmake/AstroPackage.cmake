# What `cmake --install` puts where, and the Debian package of it: the program with its man pages and completions, which it
# writes itself, udev rules, units of systemd, and the firmware images and the page that are built. The emulator stays out, because it is
# for tests.
include_guard(GLOBAL)
include(GNUInstallDirs)
set(files ${CMAKE_CURRENT_LIST_DIR}/package)

install(TARGETS astrolabe)
install(FILES ${files}/60-astrolabe.rules DESTINATION lib/udev/rules.d)
install(FILES ${files}/astrolabe-ros2@.service ${files}/astrolabe-serve@.service DESTINATION lib/systemd/system)
install(FILES ${files}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${CMAKE_SOURCE_DIR}/build/teensy40/bin/astrolabe-teensy40.hex
  ${CMAKE_SOURCE_DIR}/build/rp2040/bin/astrolabe-rp2040.uf2 DESTINATION share/astrolabe/firmware OPTIONAL)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/build/page/ DESTINATION share/astrolabe/page OPTIONAL)
install(CODE "set(program $<TARGET_FILE:astrolabe>)
  set(changelog ${files}/changelog)
  set(made ${CMAKE_BINARY_DIR}/package_texts)")
# Made in the build tree, so that nothing but what is ours is packed or taken away below the prefix.
install(CODE [[
  set(share "${CMAKE_INSTALL_PREFIX}/share")  # file(INSTALL) adds DESTDIR
  file(REMOVE_RECURSE ${made})
  file(MAKE_DIRECTORY ${made})
  execute_process(COMMAND ${program} completion bash OUTPUT_FILE ${made}/astrolabe COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${program} completion zsh OUTPUT_FILE ${made}/_astrolabe COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${program} completion fish OUTPUT_FILE ${made}/astrolabe.fish COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${program} manual ${made}/man1 COMMAND_ERROR_IS_FATAL ANY)
  file(COPY ${changelog} DESTINATION ${made})
  file(GLOB texts ${made}/man1/*.1)
  # Without names and times, so that two builds give the same bytes.
  execute_process(COMMAND gzip -9n ${texts} ${made}/changelog COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB pages ${made}/man1/*.1.gz)
  set(for_all PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(INSTALL ${made}/astrolabe DESTINATION ${share}/bash-completion/completions ${for_all})
  file(INSTALL ${made}/_astrolabe DESTINATION ${share}/zsh/vendor-completions ${for_all})
  file(INSTALL ${made}/astrolabe.fish DESTINATION ${share}/fish/vendor_completions.d ${for_all})
  file(INSTALL ${pages} DESTINATION ${share}/man/man1 ${for_all})
  file(INSTALL ${made}/changelog.gz DESTINATION ${share}/doc/astrolabe ${for_all})
]])

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME astrolabe)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "The Astrolabe authors <astrolabe@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "calibrates the odometry of differential-drive robots")
set(CPACK_PACKAGE_DESCRIPTION "Firmware and tools for robots with two driven wheels. Ground truth from a
tracker, a phone film, a wall, a laser scanner or a tape measure gives the
factors of both wheels and the wheelbase with their errors; they are loaded
into the robot, and drives before and after show what they are worth.
'astrolabe demo' does all of it with a simulated robot.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, teensy-loader-cli")  # films; flashing
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_SOURCE_DIR}/build/package)
include(CPack)
