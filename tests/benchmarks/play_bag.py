#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sends a ROS 1 bag of `heel simulate --bag` in real time, as a robot would: images raw, all stamped now.

  play_bag.py BAG    (Debian's python3-rosbag, python3-opencv; while a roscore runs)

It holds all images in memory, so that sending them costs little. It starts when somebody hears the scans.
"""
import sys
import time

import cv2
import numpy
import rosbag
import rospy
from sensor_msgs.msg import Image


def raw(message):
    picture = cv2.imdecode(numpy.frombuffer(message.data, numpy.uint8), cv2.IMREAD_COLOR)
    height, width = picture.shape[:2]
    return Image(header=message.header, height=height, width=width, encoding="bgr8", step=3 * width,
                 data=picture.tobytes())


def main():
    messages, topics = [], {}
    for topic, message, stamp in rosbag.Bag(sys.argv[1]).read_messages():
        if topic.endswith("/compressed"):
            topic, message = topic[:-len("/compressed")], raw(message)
        messages.append((stamp.to_sec(), topic, message))
    rospy.init_node("play_bag")
    for _, topic, message in messages:
        if topic not in topics:
            topics[topic] = rospy.Publisher(topic, type(message), queue_size=5, latch=topic == "/tf_static")
            if topic == "/tf_static":
                topics[topic].publish(message)
    for topic in topics:  # the first of each, for who looks what there is
        topics[topic].publish(next(message for _, name, message in messages if name == topic))
    while topics["/scan"].get_num_connections() == 0:
        time.sleep(0.1)
    time.sleep(1.0)
    began_s = time.time() - messages[0][0]
    for stamp_s, topic, message in messages:
        if topic == "/tf_static":
            continue
        time.sleep(max(0.0, began_s + stamp_s - time.time()))
        stamp = rospy.Time.from_sec(began_s + stamp_s)
        for part in message.transforms if topic == "/tf" else [message]:
            part.header.stamp = stamp
        topics[topic].publish(message)


if __name__ == "__main__":
    main()
