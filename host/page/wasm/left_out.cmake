# Sources that a page has no use for, or that need what it does not have: other programs, sockets, serial ports, OpenSSL.
# A room that calls one of them all the same is not linked.
set(ASTRO_NOT_IN_WEB
  host/base/child_process.cpp
  host/base/network.cpp
  host/formats/cdr/type_hash.cpp
  host/robot/client/discovery.cpp
  host/robot/port/open_transport.cpp
  host/robot/port/ports.cpp
  host/robot/port/serial_port.cpp
  host/robot/port/stream_transport.cpp
  host/robot/sharing/port_socket.cpp
  host/robot/sharing/relay.cpp
  host/robot/sharing/relay_server.cpp
  host/robot/sharing/shared_port.cpp)
