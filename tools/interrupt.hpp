#ifndef TINWRIGHT_TOOLS_INTERRUPT_HPP
#define TINWRIGHT_TOOLS_INTERRUPT_HPP

namespace tinwright::tools {

/// Takes charge of SIGINT, SIGTERM and SIGHUP for the process: the first asks the work to stop, the second
/// removes unfinished outputs and ends the process with status 1. SIGPIPE is ignored, so that a reader who
/// leaves early is an ordinary write error and nothing half-written stays behind.
///
/// The signals are blocked in every thread and taken by one thread that waits for them, where, unlike in
/// a handler, files may be removed. A signal that is ignored (`nohup`) stays ignored. Call once, before
/// any other thread exists.
void watch_for_interrupts();

/// Whether the user asked to stop.
bool is_interrupted();

/// Whether a step that can be left with a usable result has to be left. Ctrl-C (SIGINT) asks for no more
/// than that: it is taken here, and the steps that follow go on. Whoever ends the program by another signal
/// wants no result: that one stays for them.
bool take_interrupt();

}  // namespace tinwright::tools

#endif
