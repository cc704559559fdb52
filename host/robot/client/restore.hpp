#pragma once

namespace astro::robot {

/// Sets a variable for a scope and puts its old value back at the end, however that comes.
template <class T>
class Restore {
 public:
  Restore(T& variable, T meanwhile) : variable_(variable), before_(variable) { variable = meanwhile; }
  Restore(const Restore&) = delete;
  Restore& operator=(const Restore&) = delete;
  ~Restore() { variable_ = before_; }

 private:
  T& variable_;
  T before_;
};

}  // namespace astro::robot
