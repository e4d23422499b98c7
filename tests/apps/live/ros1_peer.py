# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""A robot by rospy: sends a scan, odometry and an image until a velocity comes, and prints that."""

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Image, LaserScan

rospy.init_node("peer", disable_signals=True)
stamp = rospy.Time(12, 500000000)

scan = LaserScan(angle_min=-1.0, angle_max=1.0, angle_increment=1.0, range_max=8.0)
scan.header.frame_id = "laser"
scan.ranges = [1.5, 2.5, 3.5]
odometry = Odometry(child_frame_id="base_footprint")
odometry.header.frame_id = "odom"
odometry.pose.pose.position.x = 0.75
odometry.pose.pose.orientation.w = 1.0
image = Image(height=2, width=2, encoding="rgb8", step=6, data=bytes(range(12)))
image.header.frame_id = "camera"

said = []
rospy.Subscriber("/cmd_vel", Twist, said.append)
senders = {
    rospy.Publisher(name, type(message), queue_size=1): message
    for name, message in (("/scan", scan), ("/odom", odometry), ("/image", image))
}
while not said:
    for sender, message in senders.items():
        message.header.stamp = stamp
        sender.publish(message)
    rospy.sleep(0.05)
print(f"{said[0].linear.x:.3f} {said[0].angular.z:.3f}")
