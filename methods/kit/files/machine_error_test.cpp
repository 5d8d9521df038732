#include "methods/kit/files/machine_error.h"

#include <gtest/gtest.h>

#include <cerrno>

#include "methods/contract/errors.h"

namespace dustbench::files {
namespace {

TEST(MachineError, IsWhatTheMachineLacksAndNothingElse) {
    for (const int error : {ENOSPC, EDQUOT, EIO, EFBIG, EMFILE, ENFILE, ENOMEM}) {
        EXPECT_TRUE(isOfMachine(error)) << error;
        EXPECT_THROW(failWriting("a/b", error), MachineError) << error;
    }
    for (const int error : {ENOENT, EACCES, EROFS, ENOTDIR, EISDIR, ENAMETOOLONG}) {
        EXPECT_FALSE(isOfMachine(error)) << error;
        EXPECT_THROW(failWriting("a/b", error), InputError) << error;
    }
}

TEST(MachineError, ADamagedFileIsNoShortage) {
    for (const int error : {EMFILE, ENFILE, ENOMEM, ENOSPC, EDQUOT, EFBIG}) EXPECT_TRUE(isShortage(error)) << error;
    for (const int error : {EIO, ENOENT, EACCES}) EXPECT_FALSE(isShortage(error)) << error;
}

TEST(MachineError, NamesThePathAndTheReason) {
    try {
        failWriting("a/b", ENOSPC);
        FAIL();
    } catch (const MachineError& error) {
        EXPECT_STREQ(error.what(), "output 'a/b' cannot be written: No space left on device");
    }
}

}  // namespace
}  // namespace dustbench::files
