#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "host/base/error.hpp"
#include "host/film/track/film_track.hpp"
#include "host/film/track/floor_survey.hpp"

/// What makes a film useless, each as one error that says where, and what a person should know about a film that is of use.
namespace astro::film {

/// No tag of the robot, or of the floor, in the key pictures; two robots.
void refuse_survey(const std::filesystem::path& film, const FilmInfo& info, const FloorSurvey& survey,
                   const FilmFigures& figures);

/// The film ends early; the robot's tag is hardly ever seen, small or blurred.
void refuse_sightings(const std::filesystem::path& film, const FilmInfo& info, const FloorSurvey& survey,
                      const FilmSightings& sightings);

/// The camera moves, or the picture does.
void refuse_motion(const std::filesystem::path& film, const CameraMotion& motion);

/// The floor tags do not lie on one plane; the robot jumps, as where a film was cut.
void refuse_track(const std::filesystem::path& film, const FilmTrack& track);

/// Where the robot drives out of the picture for more than a second. One that is carried out of it fits no place on the floor, and
/// is none of this.
std::optional<Remark> departure(const std::filesystem::path& film, const FilmTrack& track);

std::vector<Remark> remarks_on(const FilmTrack& track, const FloorSurvey& survey);

}  // namespace astro::film
