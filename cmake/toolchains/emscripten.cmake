# Debian's Emscripten (3.1.6: clang 14, libc++ 13), for the module of the web page.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
