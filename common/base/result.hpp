#pragma once

/// Result<T, E>: a value or an error, for code without exceptions.
///
/// Cost    one T, one E and a flag; no heap. T and E are small, default-constructible values.
namespace astro {

template <class T, class E>
class [[nodiscard]] Result {
 public:
  constexpr Result(const T& value) : value_(value), ok_(true) {}   // NOLINT(google-explicit-constructor)
  constexpr Result(const E& error) : error_(error), ok_(false) {}  // NOLINT(google-explicit-constructor)

  constexpr bool ok() const { return ok_; }
  constexpr explicit operator bool() const { return ok_; }

  /// Precondition: ok().
  constexpr const T& value() const { return value_; }
  constexpr const T& operator*() const { return value_; }
  constexpr const T* operator->() const { return &value_; }

  /// Precondition: not ok().
  constexpr const E& error() const { return error_; }

 private:
  T value_{};
  E error_{};
  bool ok_;
};

/// Success without a value, or an error.
template <class E>
class [[nodiscard]] Result<void, E> {
 public:
  constexpr Result() : ok_(true) {}
  constexpr Result(const E& error) : error_(error), ok_(false) {}  // NOLINT(google-explicit-constructor)

  constexpr bool ok() const { return ok_; }
  constexpr explicit operator bool() const { return ok_; }
  constexpr const E& error() const { return error_; }

 private:
  E error_{};
  bool ok_;
};

}  // namespace astro
