#pragma once

/// Message definitions (ros2msg) that several types refer to, as literals that a type appends to its own text. Each
/// part begins with the rule that separates definitions.
// Macros, because only literals can be joined to one constant without memory of their own.
#define ASTRO_MSG_RULE "================================================================================\n"
#define ASTRO_MSG_TIME ASTRO_MSG_RULE "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
#define ASTRO_MSG_HEADER \
  ASTRO_MSG_RULE "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" ASTRO_MSG_TIME
#define ASTRO_MSG_QUATERNION \
  ASTRO_MSG_RULE "MSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"
#define ASTRO_MSG_VECTOR3 ASTRO_MSG_RULE "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n"
#define ASTRO_MSG_POSE                                                               \
  ASTRO_MSG_RULE                                                                     \
  "MSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion " \
  "orientation\n" ASTRO_MSG_RULE                                                     \
  "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" ASTRO_MSG_QUATERNION
#define ASTRO_MSG_TWIST                                                            \
  ASTRO_MSG_RULE                                                                   \
  "MSG: geometry_msgs/Twist\ngeometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 " \
  "angular\n" ASTRO_MSG_VECTOR3
