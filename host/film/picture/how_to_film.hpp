#pragma once

/// Advice for each defect of a film. It is the end of the sentence that names the defect.
namespace astro::film::how_to {

inline constexpr const char* kTakeOriginal =
    ": copy the original file from the phone once more, not one that a messenger or an editor wrote; if that "
    "is it, film again and end the recording before the phone is moved";
inline constexpr const char* kOneRobot = ": film with one robot, and one print of its tag, in the picture";
inline constexpr const char* kRobotTag =
    ": lay the robot's tag flat on top of it, with a white margin all around, and film it from above in even "
    "light";
inline constexpr const char* kFloorTags =
    ": tape four to six tags flat to the floor around the field, with numbers of their own, and have all of "
    "them in the picture";
inline constexpr const char* kFlatFloorTags =
    ": tape them flat to one level floor, all of one size, and film again";
inline constexpr const char* kNearer =
    ": film from nearer or more from above, in 1080p or better, or print larger tags: 30 px of height in the "
    "farthest corner are good";
inline constexpr const char* kSharper =
    ": clean the lens, lock the focus on the floor, give more light, and film again at the highest quality";
inline constexpr const char* kWholeField =
    ": choose the place of the phone so that the robot's tag stays in the picture all the time";
inline constexpr const char* kFixedCamera =
    ": put the phone on a shelf or a tripod where nothing touches it, switch stabilisation off, and film "
    "again";
inline constexpr const char* kToTheEnd =
    ": start the film two seconds before the first drive, and end it two seconds after the last";

}  // namespace astro::film::how_to
