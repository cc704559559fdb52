#pragma once

namespace astro::bag {

/// What is missing from a bag or wrong in it, while the rest can be read. Values: the file; then of database_cut_off its size and
/// the size that it should have, of unreadable_messages the last row that could be read, and of a bag of ROS 1 the byte.
enum class BagDamage {
  file_not_there,  // values: the metadata.yaml that names it, and its name
  packed_cut_off,
  packed_too_large,
  packed_damaged,
  database_cut_off,
  too_many_topics,
  rows_out_of_order,
  unreadable_topics,
  unreadable_messages,
  message_of_unknown_topic,
  message_incomplete,
  message_does_not_expand,
  message_against_definition,
  message_too_large,
  cut_off,
  record_does_not_fit,
  chunk_too_large,
  chunk_does_not_expand,
  bad_connection
};

}  // namespace astro::bag
