// SPDX-License-Identifier: MIT
// C++ for firmware: descriptions of classes, and dynamic_cast over them. The compiler writes the
// descriptions; their layout is that of the Itanium ABI with the robot's widths.
#include <string.h>

namespace std {

class type_info {
 public:
  virtual ~type_info();
  bool same(const type_info& other) const { return name_ == other.name_ || strcmp(name_, other.name_) == 0; }
  /// Address of the only part of type `wanted` in the object of this type at `object`; null: there is none.
  virtual const void* part(const void*, const type_info&) const { return nullptr; }

 protected:
  const char* name_;
};
type_info::~type_info() {}

}  // namespace std

namespace __cxxabiv1 {

using std::type_info;

/// A class without bases.
class __class_type_info : public type_info {
 public:
  ~__class_type_info() override;
  const void* part(const void* object, const type_info& wanted) const override {
    return same(wanted) ? object : nullptr;
  }
};
__class_type_info::~__class_type_info() {}

/// One base, at the object's beginning.
class __si_class_type_info : public __class_type_info {
 public:
  ~__si_class_type_info() override;
  const void* part(const void* object, const type_info& wanted) const override {
    return same(wanted) ? object : base_->part(object, wanted);
  }

 private:
  const __class_type_info* base_;
};
__si_class_type_info::~__si_class_type_info() {}

/// Several bases, or virtual ones.
class __vmi_class_type_info : public __class_type_info {
 public:
  ~__vmi_class_type_info() override;
  const void* part(const void* object, const type_info& wanted) const override {
    if (same(wanted)) return object;
    for (unsigned i = 0; i < bases_; ++i) {
      long long offset = base_[i].offset_and_flags >> 8;
      if (base_[i].offset_and_flags & 1)  // virtual: the offset stands in the table of functions
        offset = *reinterpret_cast<const long long*>(*static_cast<const char* const*>(object) + offset);
      if (const void* found = base_[i].type->part(static_cast<const char*>(object) + offset, wanted))
        return found;
    }
    return nullptr;
  }

 private:
  unsigned flags_, bases_;
  // descriptions are laid out as on the PC, whatever the robot's alignment
  struct {
    alignas(8) const __class_type_info* type;
    long offset_and_flags;
  } base_[1];
};
__vmi_class_type_info::~__vmi_class_type_info() {}

// types without classes have descriptions as well, which nobody reads
class __fundamental_type_info : public type_info {
  ~__fundamental_type_info() override;
};
__fundamental_type_info::~__fundamental_type_info() {}
class __pointer_type_info : public type_info {
  ~__pointer_type_info() override;
};
__pointer_type_info::~__pointer_type_info() {}
class __function_type_info : public type_info {
  ~__function_type_info() override;
};
__function_type_info::~__function_type_info() {}
class __enum_type_info : public type_info {
  ~__enum_type_info() override;
};
__enum_type_info::~__enum_type_info() {}

extern "C" void* __dynamic_cast(const void* object, const __class_type_info*, const __class_type_info* wanted,
                                long long) {
  // before a table of functions stand the way to the whole object and that object's type
  const long long* table = *static_cast<const long long* const*>(object);
  const char* whole = static_cast<const char*>(object) + table[-2];
  const auto* type = reinterpret_cast<const __class_type_info* const*>(table)[-1];
  return const_cast<void*>(type->part(whole, *wanted));
}

}  // namespace __cxxabiv1
