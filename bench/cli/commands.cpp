#include "bench/cli/commands.h"

#include <exception>
#include <filesystem>
#include <new>

#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::cli {

run::RunError errorOfException() {
    using Kind = run::RunError::Kind;
    try {
        throw;
    } catch (const InputError& error) {
        return {Kind::input, error.what()};
    } catch (const std::filesystem::filesystem_error& error) {
        return {files::isOfMachine(error.code().value()) ? Kind::machine : Kind::input,
                "'" + error.path1().string() + "': " + error.code().message()};
    } catch (const SimulationError& error) {
        return {Kind::run, error.what()};
    } catch (const files::MachineError& error) {
        const std::string message = error.what();
        return {message.starts_with(files::outOfMemory) ? Kind::memory : Kind::machine, message};
    } catch (const std::bad_alloc&) {
        return {Kind::memory, files::outOfMemory};
    } catch (const std::exception& error) {
        return {Kind::internal, error.what()};
    }
}

ExitCode exitCodeOf(run::RunError::Kind kind) {
    using Kind = run::RunError::Kind;
    switch (kind) {
        case Kind::input:
            return exitBadInput;
        case Kind::run:
            return exitRunFailed;
        case Kind::machine:
        case Kind::memory:
            return exitAborted;
        case Kind::internal:
            break;
    }
    return exitInternal;
}

}  // namespace dustbench::cli
