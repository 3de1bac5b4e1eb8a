# Install rules of `cmake --install`, and the Debian packages that `Packaging/deb` builds: petrous
# (command, window, guide, device rules; of Documentation the manual, man pages and completion) and
# petrous-bench (`petrous bench`).
include(GNUInstallDirs)

install(TARGETS petrous RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT petrous)
if(TARGET petrous-workstation)
  install(TARGETS petrous-workstation
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT petrous)
  install(FILES Packaging/petrous.desktop
    DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT petrous)
  install(FILES Resources/icons/petrous.svg
    DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT petrous)
endif()
install(FILES Packaging/70-petrous-devices.rules
  DESTINATION ${PETROUS_UDEV_RULES_DIR} COMPONENT petrous)
install(FILES LICENSE README.md CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT petrous)
install(FILES LICENSE RENAME copyright # where Debian looks for it
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT petrous)
install(DIRECTORY Documentation
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT petrous
  PATTERN CMakeLists.txt EXCLUDE PATTERN conf.py EXCLUDE)
# Device servers, not where they are searched for: the user links those of the devices that exist.
get_property(servers GLOBAL PROPERTY PETROUS_DEVICE_SERVERS)
install(TARGETS ${servers} RUNTIME DESTINATION lib/petrous/device-servers COMPONENT petrous)
# What third-party device servers are built with, in C.
install(FILES
  Modules/Devices/include/petrous/Devices/DeviceServerProtocol.h
  Modules/Devices/include/petrous/Devices/DeviceServerExchange.h
  Modules/Devices/Servers/DeviceServer.h Modules/Devices/Servers/DeviceServer.c
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/petrous/Devices COMPONENT petrous)
install(TARGETS petrous-bench RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT petrous-bench)
install(PROGRAMS Testing/Benchmarks/plots.py
  DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME petrous-plots COMPONENT petrous-bench)
install(PROGRAMS Testing/Benchmarks/paraview_peer.py
  DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME petrous-paraview-peer COMPONENT petrous-bench)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME petrous)
set(CPACK_PACKAGE_CONTACT "Petrous developers <petrous@localhost>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_COMPONENTS_ALL petrous petrous-bench)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PETROUS_PACKAGE_NAME petrous)
set(CPACK_DEBIAN_PETROUS_PACKAGE_SECTION science)
# Loaded at run time, so that automatic dependencies do not include them.
set(CPACK_DEBIAN_PETROUS_PACKAGE_DEPENDS "libegl1, libopengl0, libgl1-mesa-dri | libgl1-nvidia-glvnd-glx")
set(CPACK_DEBIAN_PETROUS_PACKAGE_RECOMMENDS "libhidapi-hidraw0, fonts-dejavu-core, qttranslations5-l10n, gstreamer1.0-plugins-base, gstreamer1.0-plugins-good, gstreamer1.0-libav") # a font for reports; Qt in German; videos
set(CPACK_DEBIAN_PETROUS_PACKAGE_SUGGESTS "petrous-bench, ffmpeg, gstreamer1.0-plugins-bad, gstreamer1.0-plugins-ugly, libportaudio2") # films; videos of AVCHD and MPEG, of WMV; sound of the drill
set(CPACK_COMPONENT_PETROUS_DESCRIPTION
  "rehearsal of temporal bone surgery on the patient's own CT and MR
 Builds a scene from DICOM, shows every structure in its own colours, and lets
 it be drilled with the sense of touch, undone, and saved.")
set(CPACK_DEBIAN_PETROUS-BENCH_PACKAGE_NAME petrous-bench)
set(CPACK_DEBIAN_PETROUS-BENCH_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PETROUS-BENCH_PACKAGE_DEPENDS "petrous (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_PETROUS-BENCH_PACKAGE_RECOMMENDS python3-matplotlib) # petrous-plots
set(CPACK_DEBIAN_PETROUS-BENCH_PACKAGE_SUGGESTS elastix)
set(CPACK_COMPONENT_PETROUS-BENCH_DESCRIPTION
  "benchmarks of Petrous beside its peers
 Run time against error of import, removal, touch, registration and rendering.")
include(CPack)
