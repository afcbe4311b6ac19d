"""Logger levels, children, once, skip_first, throttle."""

import rclpy
from rclpy.logging import LoggingSeverity, get_logger_level, set_logger_level

rclpy.init()
node = rclpy.create_node("logs")
log = node.get_logger()
log.debug("hidden")
log.info("info")
log.warning("warning")
log.error("error")
log.fatal("fatal")
for number in range(3):
    log.info(f"once {number}", once=True)
    log.info(f"skip {number}", skip_first=True)
log.set_level(LoggingSeverity.DEBUG)
log.debug("now visible")
child = log.get_child("part")
child.info("from a child")
print(log.name, child.name, log.get_effective_level(), get_logger_level("logs"))
set_logger_level("logs", LoggingSeverity.ERROR)
log.warning("hidden again")
print(log.is_enabled_for(LoggingSeverity.WARN), rclpy.logging.get_logging_severity_from_string("warn"))
rclpy.shutdown()
