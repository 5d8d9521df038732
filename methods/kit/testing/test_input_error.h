// For tests: the line that a call throws.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "methods/contract/errors.h"

namespace dustbench {

/// The message of the InputError that `call` throws; a failure where it throws none or several lines.
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
