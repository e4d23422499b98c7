// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The text that tells readers of a bag what a message's fields are.
#pragma once

#include <heel/apps/bag/message_archives.hpp>

#include <set>
#include <string>

namespace heel {

/// What a type is called in a definition.
template <BagForm Form, class T>
std::string typeName() {
  if constexpr (std::is_same_v<T, bool>) {
    return "bool";
  } else if constexpr (std::is_same_v<T, char>) {
    return "byte";
  } else if constexpr (std::is_integral_v<T>) {
    return (std::is_signed_v<T> ? "int" : "uint") + std::to_string(8 * sizeof(T));
  } else if constexpr (std::is_floating_point_v<T>) {
    return "float" + std::to_string(8 * sizeof(T));
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "string";
  } else if constexpr (std::is_same_v<T, StampMsg>) {
    return Form == BagForm::kRos1 ? "time" : "builtin_interfaces/Time";
  } else if constexpr (std::is_same_v<T, DurationMsg>) {
    return Form == BagForm::kRos1 ? "duration" : "builtin_interfaces/Duration";
  } else if constexpr (IsVector<T>::value) {
    return typeName<Form, typename T::value_type>() + "[]";
  } else if constexpr (IsArray<T>::value) {
    return typeName<Form, typename T::value_type>() + "[" + std::to_string(std::tuple_size_v<T>) +
           "]";
  } else {
    return T::kType;
  }
}

template <class T, class = void>
struct ConstantsOf {
  static constexpr const char* kText = "";
};
template <class T>
struct ConstantsOf<T, std::void_t<decltype(T::kConstants)>> {
  static constexpr const char* kText = T::kConstants;
};

/// Collects the definition of a message, and of those in it, from its fields.
template <BagForm Form>
class DefinitionText {
 public:
  static constexpr BagForm kForm = Form;

  template <class T>
  void operator()(const char* name, const T& value) {
    text_ += typeName<Form, T>() + " " + name + "\n";
    addNested(value);
  }

  template <class Message>
  void describe(const Message& message) {
    text_ += ConstantsOf<Message>::kText;
    Message::fields(message, *this);
  }

  std::string text() const { return text_ + nested_; }

 private:
  template <class T>
  void addNested(const T& value) {
    constexpr bool kIsTime = std::is_same_v<T, StampMsg> || std::is_same_v<T, DurationMsg>;
    if constexpr (IsVector<T>::value) {
      addNested(typename T::value_type());
    } else if constexpr (kIsTime && Form == BagForm::kRos2) {
      addPart(typeName<Form, T>(), "int32 sec\nuint32 nanosec\n");
    } else if constexpr (std::is_class_v<T> && !IsArray<T>::value &&
                         !std::is_same_v<T, std::string> && !kIsTime) {
      if (known_.count(T::kType) > 0) return;
      DefinitionText inner;
      inner.known_ = known_;
      inner.known_.insert(T::kType);
      inner.describe(value);
      addPart(T::kType, inner.text());
      known_ = inner.known_;
    }
  }

  void addPart(const std::string& type, const std::string& text) {
    if (!known_.insert(type).second) return;
    nested_ += std::string(80, '=') + "\nMSG: " + type + "\n" + text;
  }

  std::string text_, nested_;
  std::set<std::string> known_;
};

template <class Message>
std::string definitionOf(BagForm form) {
  const auto text = [](auto definition) {
    definition.describe(Message());
    return definition.text();
  };
  return form == BagForm::kRos1 ? text(DefinitionText<BagForm::kRos1>())
                                : text(DefinitionText<BagForm::kRos2>());
}

}  // namespace heel
