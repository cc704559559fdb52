#pragma once

namespace astro::robot {

/// Sets a variable for a scope and restores its old value at the end, however the scope is left.
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
