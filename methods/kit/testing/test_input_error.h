// For tests: the message of the InputError that a call throws.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "methods/contract/errors.h"

namespace dustbench {

/// The message of the InputError that `call` throws; fails the test if there is none or it has several lines.
template <typename Call>
std::string inputError(const Call& call) {
    try {
        call();
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message;
    }
    ADD_FAILURE() << "expected an InputError";
    return "";
}

}  // namespace dustbench
