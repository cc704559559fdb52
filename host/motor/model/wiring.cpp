#include "host/motor/model/wiring.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace astro::motor {
namespace {

constexpr long kMoved_counts = 24, kToggles = 12;

/// The encoder that counted during a probe, and its motion.
struct Answer {
  std::optional<Side> encoder;
  Motion motion = Motion::none;
};

// The encoder with the most counts; a toggling one only if none moved. On the ground the other wheel may be
// dragged along a little.
Answer answer_to(const Probe& probe) {
  Answer answer;
  long most = 0;
  for (const Side side : kSides) {
    const EncoderTrace& trace = probe.encoders[at(side)];
    const Motion motion = motion_of(trace);
    const bool goes = motion == Motion::forward || motion == Motion::backward;
    const long weight = goes ? std::labs(trace.counts) : motion == Motion::toggles ? 1 : 0;
    if (weight <= most) continue;
    most = weight;
    answer = {side, motion};
  }
  return answer;
}

class Judge {
 public:
  Judge(const std::array<Probe, 2>& probes, const Polarities& polarities)
      : probes_(probes), polarities_(polarities), answers_{answer_to(probes[0]), answer_to(probes[1])} {}

  WiringVerdict verdict() {
    const bool looked = probes_[0].seen.has_value() && probes_[1].seen.has_value();
    if (looked)
      by_eye();
    else
      by_counts();
    return std::move(verdict_);
  }

 private:
  void find(std::string fault, std::string sentence) {
    verdict_.findings.push_back({std::move(fault), {std::move(sentence)}});
  }
  void by_hand(std::string fault, std::string sentence) {
    find(std::move(fault), std::move(sentence));
    verdict_.needs_hands = true;
  }

  void by_eye();
  bool same_wheel_twice();
  void place_motors();
  void place_encoders();
  void orient(Side channel);
  void judge_encoder(Side channel, Side wheel);
  void by_counts();
  void by_counts(Side channel);

  const std::array<Probe, 2>& probes_;
  const Polarities& polarities_;
  std::array<Answer, 2> answers_;  // by motor channel
  WiringVerdict verdict_;
};

void Judge::by_eye() {
  if (same_wheel_twice()) return;
  place_motors();
  place_encoders();
  for (const Side channel : kSides) orient(channel);
}

bool Judge::same_wheel_twice() {
  const auto left = probes_[0].seen->wheel, right = probes_[1].seen->wheel;
  if (!left || left != right) return false;
  by_hand("one_wheel",
          fmt::format("both motor outputs turn the {} wheel: look at which leads go where, and check again",
                      name(*left)));
  return true;
}

void Judge::place_motors() {
  bool crossed = false;
  for (const Side channel : kSides) {
    const auto wheel = probes_[at(channel)].seen->wheel;
    crossed = crossed || (wheel && *wheel != channel);
  }
  if (crossed)
    by_hand("motors_swapped",
            "the motors are swapped: exchange the leads of the left and the right motor at the driver");
}

void Judge::place_encoders() {
  bool crossed = false;
  for (const Side channel : kSides) {
    const auto wheel = probes_[at(channel)].seen->wheel;
    const Answer& answer = answers_[at(channel)];
    crossed = crossed || (wheel && answer.encoder && *answer.encoder != *wheel);
  }
  if (crossed)
    by_hand("encoders_swapped",
            "the encoders are swapped: exchange the plugs of the left and the right encoder");
}

// The polarities belong to the wheel: they are right once its motor and encoder are connected to it.
void Judge::orient(Side channel) {
  const Sighting& seen = *probes_[at(channel)].seen;
  if (!seen.wheel) {
    if (answers_[at(channel)].motion == Motion::none)
      by_hand(
          fmt::format("{}_motor_dead", name(channel)),
          fmt::format("the {} motor does not turn at {:.1f} V: look at its leads, the driver and its supply",
                      name(channel), probes_[at(channel)].voltage_V));
    else
      find("contradiction", fmt::format("an encoder counted while no wheel was seen turning for the {} "
                                        "motor: check again and look closely",
                                        name(channel)));
    return;
  }
  const Side wheel = *seen.wheel;
  const int turned = seen.forward ? 1 : -1;
  const int motor = turned * polarities_.motor[at(channel)];
  if (turned < 0)
    find(fmt::format("{}_motor_reversed", name(wheel)),
         fmt::format("the {} motor turns backward: motor_polarity_{} = {} turns it round", name(wheel),
                     name(wheel), motor));
  if (motor != polarities_.motor[at(wheel)])
    verdict_.parameters[fmt::format("motor_polarity_{}", name(wheel))] = motor;
  judge_encoder(channel, wheel);
}

void Judge::judge_encoder(Side channel, Side wheel) {
  const Answer& answer = answers_[at(channel)];
  if (answer.motion == Motion::none)
    return by_hand(fmt::format("{}_encoder_dead", name(wheel)),
                   fmt::format("the {} encoder does not count while its wheel turns: look at its plug, its "
                               "supply and both channels",
                               name(wheel)));
  if (answer.motion == Motion::toggles)
    return by_hand(fmt::format("{}_channel_missing", name(wheel)),
                   fmt::format("the {} encoder counts up and down by one: one of its two channels does not "
                               "arrive; look at both wires",
                               name(wheel)));
  const int turned = probes_[at(channel)].seen->forward ? 1 : -1;
  const int counted = answer.motion == Motion::forward ? 1 : -1;
  const int encoder = turned * counted * polarities_.encoder[at(*answer.encoder)];
  if (turned != counted)
    find(fmt::format("{}_encoder_reversed", name(wheel)),
         fmt::format("the {} encoder counts the wrong way: encoder_polarity_{} = {} turns it round",
                     name(wheel), name(wheel), encoder));
  if (encoder != polarities_.encoder[at(wheel)])
    verdict_.parameters[fmt::format("encoder_polarity_{}", name(wheel))] = encoder;
}

void Judge::by_counts() {
  const auto crosses = [&](Side channel) {
    const Answer& answer = answers_[at(channel)];
    return answer.encoder && *answer.encoder != channel;
  };
  verdict_.needs_eyes = true;
  if (crosses(Side::left) || crosses(Side::right))
    by_hand("motors_or_encoders_swapped",
            "the motors or the encoders are swapped: which of them, only who sees the wheels turn can say");
  for (const Side channel : kSides) by_counts(channel);
}

void Judge::by_counts(Side channel) {
  const Answer& answer = answers_[at(channel)];
  const char* side = name(channel);
  switch (answer.motion) {
    case Motion::none:
      return by_hand(fmt::format("{}_motor_or_encoder_dead", side),
                     fmt::format("no encoder counts while the {} motor is driven: either the motor does not "
                                 "turn or its encoder is off",
                                 side));
    case Motion::toggles:
      return by_hand(fmt::format("{}_channel_missing", name(*answer.encoder)),
                     fmt::format("the {} encoder counts up and down by one: one of its two channels does not "
                                 "arrive; look at both wires",
                                 name(*answer.encoder)));
    case Motion::backward:
      return find(fmt::format("{}_motor_or_encoder_reversed", side),
                  fmt::format("the {} wheel counts backward while its motor is driven forward: motor or "
                              "encoder is reversed, and which only who sees the wheel turn can say",
                              side));
    case Motion::forward:
      return;
  }
}

}  // namespace

Motion motion_of(const EncoderTrace& trace) {
  if (trace.counts >= kMoved_counts) return Motion::forward;
  if (trace.counts <= -kMoved_counts) return Motion::backward;
  return trace.range <= 2 && trace.changes >= kToggles ? Motion::toggles : Motion::none;
}

WiringVerdict judge_wiring(const std::array<Probe, 2>& probes, const Polarities& polarities) {
  return Judge(probes, polarities).verdict();
}

}  // namespace astro::motor
