#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "host/base/error.hpp"
#include "host/film/track/film_track.hpp"
#include "host/film/track/floor_survey.hpp"

/// Throws an error for each defect that makes a film useless, which says where it is, and collects remarks on
/// a film that can be used.
namespace astro::film {

/// Refuses a film whose key pictures show no tag of the robot, no tag on the floor, or two robots.
void refuse_survey(const std::filesystem::path& film, const FilmInfo& info, const FloorSurvey& survey,
                   const FilmFigures& figures);

/// Refuses a film that ends early, or in which the robot's tag is hardly ever seen, is too small, or is blurred.
void refuse_sightings(const std::filesystem::path& film, const FilmInfo& info, const FloorSurvey& survey,
                      const FilmSightings& sightings);

/// Refuses a film whose camera was moved, or whose picture shakes.
void refuse_motion(const std::filesystem::path& film, const CameraMotion& motion);

/// Refuses a film whose floor tags do not lie on one plane, or in which the robot jumps, as it does where a
/// film was cut.
void refuse_track(const std::filesystem::path& film, const FilmTrack& track);

/// Says where the robot drives out of the picture for more than a second. A robot that is lifted and carried out does not count: its
/// tag leaves the floor, so its last poses do not fit the scene.
std::optional<Remark> departure(const std::filesystem::path& film, const FilmTrack& track);

std::vector<Remark> remarks_on(const FilmTrack& track, const FloorSurvey& survey);

}  // namespace astro::film
