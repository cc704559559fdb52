#pragma once

#include <string>

/// Small recordings in the formats of trackers, made for the tests.
namespace astro::test {

/// Motive 1.23, one body with quaternions and one marker; four frames, of which one is lost.
inline const std::string kMotive =
    "Format Version,1.23,Take Name,\"drive, slow\",Take Notes,,Capture Frame Rate,120.000000,Export Frame "
    "Rate,"
    "120.000000,Capture Start Time,2026-08-04 03.25.40.230 PM,Total Frames in Take,4,Total Exported Frames,4,"
    "Rotation Type,Quaternion,Length Units,Millimeters,Coordinate Space,Global\r\n"
    "\r\n"
    ",Type,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid "
    "Body,Marker,Marker,"
    "Marker\r\n"
    ",Name,astro,astro,astro,astro,astro,astro,astro,astro,loose 1,loose 1,loose 1\r\n"
    ",ID,\"4CF0\",\"4CF0\",\"4CF0\",\"4CF0\",\"4CF0\",\"4CF0\",\"4CF0\",\"4CF0\",\"5A\",\"5A\",\"5A\"\r\n"
    ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position,Mean Marker "
    "Error,Position,Position,Position\r\n"
    "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,,X,Y,Z\r\n"
    "72,0.600000,0.000000,0.099833,0.000000,0.995004,100.0,50.0,-200.0,0.0001,1,2,3\r\n"
    "73,0.608333,0.000000,-0.100831,0.000000,-0.994903,100.1,50.0,-200.2,0.0001,1,2,3\r\n"
    "74,0.616667,,,,,,,,,1,2,3\r\n"
    "77,0.641667,0.000000,0.102825,0.000000,0.994699,100.3,50.0,-200.6\r\n";

/// Vicon Tracker, two bodies with rotation vectors.
inline const std::string kVicon =
    "\xEF\xBB\xBFObjects\r\n100\r\n"
    ",,Global Angle astro:astro,,,,,,Global Angle wand:wand,,,,,\r\n"
    "Frame,Sub Frame,RX,RY,RZ,TX,TY,TZ,RX,RY,RZ,TX,TY,TZ\r\n"
    ",,rad,rad,rad,mm,mm,mm,deg,deg,deg,mm,mm,mm\r\n"
    "11,0,0,0,3.0,1000,2000,150,0,0,10,1,2,3\r\n"
    "12,0,0,0,3.3,1001,2000,150,0,0,20,1,2,3\r\n"
    "13,0,,,,,,,0,0,30,1,2,3\r\n"
    "15,0,0,0,6.1,1003,2000,150\r\n"
    "\r\n"
    "Trajectories\r\n100\r\n,,astro:m1,,\r\nFrame,Sub Frame,X,Y,Z\r\n,,mm,mm,mm\r\n11,0,1,2,3\r\n";

inline const std::string kTum =
    "# timestamp tx ty tz qx qy qz qw\n"
    "1700000000.123456789 1.5 -0.25 0.1 0 0 0.7071 0.7071\n"
    "1.700000000223456789e+09\t1.6  -0.25 1e-1 0 0 0.7071 0.7071 \n"
    "1700000000.3 1.7 -0.25 0.1 0 0 0 0\n";

inline const std::string kEuroc =
    "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n"
    "1403715529112143517,0.5,0.25,0.125,0.9,0.1,0.2,0.3,0,0,0\n"
    "1403715529117143517,0.5,0.25,0.125,0.9,0.1,0.2,0.3,0,0,0\n";

inline const std::string kPlain =
    "time_ms,x_mm,y_mm,theta_deg,battery\n1000,100,200,90,7\n1010.5,110,210,180,7\n1020,,,,7\n";

}  // namespace astro::test
